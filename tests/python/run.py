"""Runs pytest on its arguments; a line and 77 where it is not installed."""

import sys

try:
    import pytest
except ImportError:
    print("tests/python: Skipped\npytest is not installed (package python3-pytest)")
    sys.exit(77)
sys.exit(pytest.main(sys.argv[1:]))
