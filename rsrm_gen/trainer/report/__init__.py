"""The page of a run: one HTML file that needs nothing else, no network and no library."""

from rsrm_gen.trainer.report.page import write_report

__all__ = ["write_report"]
