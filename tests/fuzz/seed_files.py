"""Where the seeds of the fuzz targets go: tests/fuzz/seeds/TARGET/NAME."""

import pathlib

SEEDS = pathlib.Path(__file__).parent / "seeds"


def write(target, name, data):
    folder = SEEDS / target
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(data if isinstance(data, bytes) else data.encode())
