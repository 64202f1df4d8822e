"""The compiler: manifold files to audited torch and C code. `driver.py` is the pipeline."""
