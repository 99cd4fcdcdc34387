"""Fixtures: the built program, and a quiet module."""

import os
import subprocess
import sys

import pytest
import restlab

restlab.set_verbosity(-1)


@pytest.fixture
def program(tmp_path):
    """Runs `restlab arguments...` in a folder of the test; returns what it prints."""

    def run(*arguments):
        words = [os.environ["RESTLAB_PROGRAM"], *map(str, arguments)]
        done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, timeout=300)
        assert done.returncode in (0, 1), done.stderr
        return done.stdout

    return run


@pytest.fixture
def script(tmp_path):
    """Runs a script in an interpreter of its own; returns what it prints."""

    def run(text):
        done = subprocess.run(
            [sys.executable, "-c", text], cwd=tmp_path, capture_output=True, text=True, timeout=300
        )
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run
