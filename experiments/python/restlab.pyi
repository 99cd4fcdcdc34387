"""restlab: sessions, references, metrics and results of restlab for scripts.

Images are arrays of numpy: float32 (height, width, 3), linear Rec. 709, row 0 on top. Errors are
restlab.Error, with one line. docs/python.md has examples.
"""

from os import PathLike
from typing import Any, Mapping, Sequence, Union

import numpy as np
import numpy.typing as npt

Image = npt.NDArray[np.float32]
Path = Union[str, "PathLike[str]"]
Value = Union[bool, int, float, str]
Vector = Sequence[float]

__version__: str

class Error(RuntimeError):
    """What is wrong with a setting, a file or a device, in one line."""

    exit_code: int
    """The exit code of the program: 2 bad usage, 3 bad input, 4 device, 130 interrupted; else 3."""

class FrameStats:
    """Times and counts of a frame."""

    @property
    def time_ms(self) -> float:
        """Sum of the passes, without work for the scene; milliseconds."""
    @property
    def scene_ms(self) -> float:
        """Work for the scene that this frame did."""
    @property
    def rays_path(self) -> int: ...
    @property
    def rays_shadow(self) -> int: ...
    @property
    def passes(self) -> list[dict[str, Any]]:
        """One dict a pass: name, time_ms, rays_path, rays_shadow, once."""
    @property
    def health(self) -> dict[str, int]:
        """Counts of numerical health, by name."""

class Session:
    """A scene and a method that renders its frames. One thread may use it at a time."""

    def __init__(
        self,
        scene: Path,
        *,
        integrator: str = "path",
        mode: str = ...,
        cache: str = ...,
        denoiser: str = "none",
        width: int | None = None,
        height: int | None = None,
        seed: int = 1,
        camera: str | int | None = None,
        component: str = "all",
        environment: Path | None = None,
        environment_rotation: float | None = None,
        environment_scale: float | None = None,
        backend: str = "cpu",
        device: str | None = None,
        ray_tracing: str | None = None,
        validate: bool = False,
        kernels: str | None = None,
        threads: int = 0,
        max_bounces: int | None = None,
        russian_roulette: bool = False,
        filter: str = "box",
        multiscatter: bool = False,
        light_choice: str = "power",
        **parameters: Value,
    ) -> None: ...
    def frame(self) -> FrameStats:
        """Renders the next frame of the history."""
    def frames(self, count: int) -> list[FrameStats]:
        """Renders several frames without reading their images."""
    def radiance(self) -> Image:
        """The image of the last frame, read-only and not copied. It stays as it is."""
    def aov(self, name: str) -> Image:
        """A layer of the last frame, one of aov_names."""
    def probe(self, x: int, y: int) -> dict[str, Any]:
        """What the method keeps of a pixel: values, the path of its sample, its donors."""
    def set_parameters(self, **parameters: Value) -> bool:
        """Changes parameters of the method. Returns whether the history starts anew."""
    def set_camera(
        self,
        name: str | int | None = None,
        *,
        position: Vector = ...,
        target: Vector = ...,
        direction: Vector = ...,
        up: Vector = ...,
        yfov: float = ...,
    ) -> None:
        """Sets a camera of the scene, then what the keywords say; metres, degrees."""
    def reset(self, seed: int | None = None, *, first_frame: int = 0) -> None:
        """Starts a new history, with another seed if one is given."""
    def resize(self, width: int, height: int) -> None:
        """Changes the size of the image; the history starts anew."""
    def reference(
        self,
        *,
        spp: int | None = None,
        target_relmse: float | None = None,
        time_limit: float | None = None,
        integrator: str = "path",
        file: Path | None = None,
        anew: bool = False,
    ) -> Reference:
        """The reference of what this session shows: scene, camera, size, light transport."""
    @property
    def aov_names(self) -> list[str]: ...
    @property
    def layers(self) -> list[dict[str, str]]: ...
    @property
    def parameters(self) -> dict[str, Value]: ...
    @property
    def settings(self) -> dict[str, Value]: ...
    @property
    def metadata(self) -> dict[str, str]:
        """Words that `restlab render` writes into its EXR, of the last frame; for write_exr()."""
    @property
    def cameras(self) -> list[str]: ...
    @property
    def camera(self) -> dict[str, Any]:
        """The camera: name, position, direction, up, yfov."""
    @property
    def frame_count(self) -> int: ...
    @property
    def time_ms(self) -> float: ...
    @property
    def health(self) -> dict[str, int]: ...
    @property
    def device(self) -> str: ...

class Reference:
    """A converged image, in two independent halves where they are known."""

    def __init__(
        self, mean: npt.NDArray[np.floating[Any]], half0: Any = None, half1: Any = None
    ) -> None: ...
    @property
    def mean(self) -> Image: ...
    @property
    def half0(self) -> Image | None: ...
    @property
    def half1(self) -> Image | None: ...
    @property
    def variance(self) -> Image | None: ...
    @property
    def spp(self) -> int: ...
    @property
    def relmse(self) -> float:
        """Its own relmse_e1e-2, estimated from the halves; nan where unknown."""
    @property
    def time_s(self) -> float: ...
    @property
    def not_converged(self) -> str:
        """Why it is not converged, whatever its halves agree on; or ''."""
    @property
    def metadata(self) -> dict[str, str]: ...
    def write(self, file: Path) -> None: ...

def reference(
    scene: Path,
    *,
    spp: int | None = None,
    target_relmse: float | None = None,
    time_limit: float | None = None,
    integrator: str = "path",
    file: Path | None = None,
    anew: bool = False,
    **settings: Any,
) -> Reference:
    """Renders a converged image in two halves, as `restlab reference` does."""

def read_reference(file: Path) -> Reference: ...
def metric(
    name: str,
    image: npt.NDArray[np.floating[Any]] | Sequence[npt.NDArray[np.floating[Any]]],
    reference: Reference | npt.NDArray[np.floating[Any]],
    *,
    mask: npt.NDArray[np.bool_] | None = None,
    pixels_per_degree: float = ...,
) -> float:
    """Error of an image, one of metric_names(). bias_rms takes a list of independent runs."""

def metrics(
    image: npt.NDArray[np.floating[Any]],
    reference: Reference | npt.NDArray[np.floating[Any]],
    names: Sequence[str] | None = None,
    *,
    mask: npt.NDArray[np.bool_] | None = None,
    pixels_per_degree: float = ...,
) -> dict[str, float]:
    """Several errors of an image by name: a list of names, or 'all'."""

def metric_names() -> list[str]: ...
def read_exr(file: Path) -> dict[str, Image]:
    """Layers of an EXR by name; '' is the image itself."""

def read_metadata(file: Path) -> dict[str, str]: ...
def write_exr(
    file: Path,
    image: npt.NDArray[np.floating[Any]],
    *,
    layers: Mapping[str, npt.NDArray[np.floating[Any]]] = ...,
    metadata: Mapping[str, str] = ...,
) -> None: ...
def write_png(
    file: Path, image: npt.NDArray[np.floating[Any]], *, exposure: float = 1.0
) -> None: ...
def load_results(folder: Path, *, as_dicts: bool = False) -> Any:
    """The summary of a folder of `restlab run`: a pandas.DataFrame, or a list of dicts."""

def bias(
    scene: Path,
    *,
    runs: int | None = None,
    margin: float = 0.5,
    against: str = "path",
    warmup: int | None = None,
    frames: int | None = None,
    time_limit: float = 0.0,
    jobs: int = 0,
    out: Path | None = None,
    **settings: Any,
) -> dict[str, Any]:
    """The certificate of `restlab bias`: is a method biased?"""

def scenes() -> list[dict[str, Any]]: ...
def integrators() -> list[dict[str, Any]]: ...
def caches() -> list[dict[str, Any]]: ...
def denoisers() -> list[dict[str, Any]]: ...
def backends() -> list[dict[str, Any]]: ...
def set_verbosity(level: int) -> None:
    """What is said on stderr. -1: warnings alone; 0: with progress; 1: details."""
