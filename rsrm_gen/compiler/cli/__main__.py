"""`python -m rsrm_gen.compiler.cli`."""

from rsrm_gen.compiler.cli import main

if __name__ == "__main__":
    main()
