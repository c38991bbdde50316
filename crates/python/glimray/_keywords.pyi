"""Keywords of functions, for editors and type checkers; crates/python/keywords.py writes this file."""

from collections.abc import Iterable, Mapping
from os import PathLike
from typing import Any, Literal, TypeAlias, TypedDict

Choice: TypeAlias = int | str
"""A number or a name."""
Numbers: TypeAlias = Iterable[float] | str
"""Such as (0, 1, 4), an array, or "0,1,4"."""
Path: TypeAlias = str | PathLike[str]
Pixels: TypeAlias = Any
"""An array of (height, width, 3 or 4)."""


class RenderKeywords(TypedDict, total=False):
    """Keywords of `render`."""

    layers: Iterable[Literal["beauty", "albedo", "normal", "depth", "position", "uv", "object", "material", "direct", "indirect", "emission", "variance", "samples"]] | str | None
    """Layers to write to one OpenEXR file (.exr) or to keep in a film (.film), separated by commas."""
    size: tuple[int, int] | list[int] | str | None
    """Width and height in pixels [default: the scene's, else 640x480; 800x600 for models]."""
    samples: int | None
    """Samples per pixel, 1 to 65536 [default: the scene's; 8 of models, which are denoised, also with more; else 64 for
    integrator path, 16 with a lens, an area light or motion blur; else 1]."""
    antialias: Literal["none", "stratified", "adaptive"] | None
    """Distribution of the samples within a pixel [default: stratified for more than one sample, else none]."""
    noise: float | None
    """Noise threshold of adaptive sampling, 0.000001 to 1 [default: the scene's, else 0.01]."""
    max_depth: int | None
    """Bounces after the first hit, 0 to 1000; 0 is local shading only [default: the scene's, else 5; 0 for .scene; 16
    for integrator path; 8 for models by integrator whitted]."""
    min_throughput: float | None
    """Terminate reflection and refraction rays below this throughput, 0 to 1 [default: 1/512]."""
    transparent_shadows: bool | None
    """Path tracing: let all glass filter shadow rays in straight lines, which loses caustics."""
    bsdf: Literal["full", "spec"] | None
    """How metallic-roughness materials scatter in path-traced pictures [default: full]."""
    clamp_indirect: float | None
    """Path tracing: clamp what a sample gains at once from indirect light to this radiance, above 0 to 1e6 [default: no
    limit]."""
    filter: Literal["box", "tent", "gaussian", "blackman-harris", "mitchell"] | None
    """Reconstruction filter [default: the scene's, else box]."""
    filter_radius: float | None
    """Radius of the reconstruction filter, 0.01 to 16 [default: box 0.5, tent 1, mitchell 2, others 1.5]."""
    light_samples: float | None
    """Multiply the sample count of every area light by this, 0.001 to 1000 [default: the scene's, else 1]."""
    integrator: Literal["whitted", "path", "lecture", "normals", "depth", "ids", "uv", "heat", "samples"] | None
    """Integrator or debug view [default: the scene's, else path for models and whitted for scenes]."""
    triangle_test: Literal["plane", "moller-trumbore", "watertight"] | None
    """Ray–triangle intersection algorithm [default: watertight]."""
    offset: str | None
    """Origin of reflected, refracted and shadow rays: bound or fixed:EPS."""
    no_bvh: bool | None
    """Test every primitive for every ray instead of traversing the BVH: the same picture, but slow."""
    seed: int | None
    """Random seed; the same scene, settings and seed give the same picture [default: 0]."""
    crop: tuple[int, int, int, int] | list[int] | str | None
    """Render only columns X0 to X1-1 and rows Y0 to Y1-1, in pixels from the top left."""
    exposure: float | Literal["auto"] | None
    """Exposure: multiply radiance by 2^EV, -64 to 64 [default: the scene's, else 0; 0 for .exr and .hdr]."""
    tone: Literal["none", "aces", "agx", "reinhard", "neutral"] | None
    """Tone curve [default: the scene's, else for paths neutral in models, none in bare ones, agx in scenes; none for
    whitted, .exr, .hdr and debug views]."""
    transfer: Literal["srgb", "linear"] | None
    """Transfer function [default: the scene's, else srgb; srgb too where paths bring their curve to a scene for
    whitted; linear for .exr, .hdr and debug views]."""
    denoise: bool | None
    """Denoise the picture [default: that of models, as the scene says for others]; films and, with layers, the layer
    beauty keep the noise."""
    no_denoise: bool | None
    """Show the samples as they are, also of a model; samples 64 then has less noise."""
    camera: Choice | None
    """Camera of the scene, by its name or its number in `inspect`."""
    fov_y: float | None
    """Vertical field of view in degrees, 0.001 to 179.9; selects perspective projection."""
    orthographic: float | None
    """Orthographic projection with a view of this height, in scene units, 1e-9 to 1e9."""
    look_from: Numbers | None
    """Camera position, in scene units."""
    look_at: Numbers | None
    """Point at the centre of the picture, in scene units."""
    up: Numbers | None
    """Up direction of the camera; or with a letter the axis of a model that points up [default of models: z for .stl,
    else y]."""
    background: Numbers | None
    """Background colour: linear radiance, 0 or more per channel; or transparent."""
    section: Numbers | None
    """Cut away what lies beyond a plane: points p with X·p.x + Y·p.y + Z·p.z > OFFSET, or none."""
    frame: int | None
    """Render this frame of the scene's animation."""
    time: float | None
    """Render the scene's animation at this time, -1e6 to 1e6 [default: 0]."""
    fps: float | None
    """Frames per second, 0.01 to 1000; frame N is at N / FPS seconds [default: the scene's, else 24]."""
    shutter: float | tuple[float, float] | str | None
    """Shutter interval for motion blur [default: the scene's, else 0]."""
    strict: bool | None
    """Refuse a scene if anything in it would be skipped or repaired."""
    set: Mapping[str, Any] | Iterable[str] | str | None
    """Override a value of a native scene, such as camera.fov_y_deg=30 (repeatable)."""
    allow_dir: Iterable[Path] | Path | None
    """Allow the scene to read files from this folder as well as its own (repeatable)."""
    scene: Choice | None
    """Scene of a glTF model, by its name or number [default: the model's]."""
    clip: Choice | None
    """Clip of a glTF model to play, by its name or number [default: all that fit together]."""
    variant: Choice | None
    """Variant of a glTF model's materials, by its name or number [default: the model's]."""
    texture_limit: float | None
    """Halve pictures of textures and backgrounds until no side is longer than this, in pixels, which is reported
    [default: no limit; all pictures together take at most 2.75 GiB]."""
    environment: Path | Pixels | None
    """Replace the background: an equirectangular picture (.hdr, .exr, .png, .jpg, .webp), a built-in environment, which
    is noon, sunset, overcast, studio, ring or furnace, or a clear sky with the sun at this elevation, 0 to 90, and
    azimuth from -z towards +x, in degrees [default of sky: 45,-135]."""
    environment_strength: float | None
    """Factor on the radiance of the background, 0 to 1e6."""
    environment_rotation: float | None
    """Turn the picture of the background about +y by this angle in degrees, counter-clockwise seen from above."""
    fit: bool | None
    """Frame the model, whatever its own cameras show."""
    bare: bool | None
    """Add nothing to a model: no camera that frames it, no lights, no background, no ground, no tone curve."""
    no_lights: bool | None
    """Add no lamps to a model without lights, or with weak ones; its background still lights paths."""
    no_background: bool | None
    """Add no background to a model without lights, or with weak ones: it is black."""
    no_ground: bool | None
    """Add no ground to a model without lights, or with weak ones; background leaves it out too."""
    ground: Literal["surface", "shadow"] | None
    """The ground below a model: a surface, or only the shadow on it, with a transparent background [default: a surface
    below models without lights or with weak ones, if no background is given]."""
    adapter: Choice | None
    """GPU adapter, by its number in `doctor` or part of its name [default: the fastest]."""
    backend: Literal["vulkan", "metal", "dx12", "gl"] | None
    """Graphics API [default: the best available]."""
    memory_limit: int | None
    """Refuse scenes that need more GPU memory than this, in MiB."""
    count_rays: bool | None
    """Count the rays of each kind for the report, at a small cost in speed."""


class AnimateKeywords(TypedDict, total=False):
    """Keywords of `animate`."""

    quality: int | None
    """Quality of JPEG frames and videos, 1 (smallest file) to 100 (best)."""
    frames_dir: Path | None
    """Folder for the frames of a video [default: OUT.frames beside it; none for `-`]."""
    keep_frames: bool | None
    """Keep the frames of a video after it is written, as frames_dir and encode_only do."""
    discard_frames: bool | None
    """Remove the frames after the video is written even with frames_dir or encode_only."""
    layers: Iterable[Literal["beauty", "albedo", "normal", "depth", "position", "uv", "object", "material", "direct", "indirect", "emission", "variance", "samples"]] | str | None
    """Layers to write to one OpenEXR file (.exr) or to keep in a film (.film), separated by commas."""
    frames: tuple[int, int] | list[int] | str | None
    """Frames A to B inclusive; A.. runs to the end of the animation, A is a single frame [default: the whole
    animation]."""
    step: int | None
    """Render every Nth frame; a video keeps its duration at a lower frame rate."""
    loop: bool | None
    """Loop: leave out the last frame, at which the animation begins again, and repeat a GIF forever."""
    fps: float | None
    """Frames per second, 0.01 to 1000; frame N is at N / FPS seconds [default: the scene's, else 24]."""
    shutter: float | tuple[float, float] | str | None
    """Shutter interval for motion blur [default: the scene's, else 0]."""
    size: tuple[int, int] | list[int] | str | None
    """Width and height in pixels [default: the scene's, else 640x480; 800x600 for models]."""
    samples: int | None
    """Samples per pixel, 1 to 65536 [default: the scene's; 8 of models, which are denoised, also with more; else 64 for
    integrator path, 16 with a lens, an area light or motion blur; else 1]."""
    antialias: Literal["none", "stratified", "adaptive"] | None
    """Distribution of the samples within a pixel [default: stratified for more than one sample, else none]."""
    noise: float | None
    """Noise threshold of adaptive sampling, 0.000001 to 1 [default: the scene's, else 0.01]."""
    max_depth: int | None
    """Bounces after the first hit, 0 to 1000; 0 is local shading only [default: the scene's, else 5; 0 for .scene; 16
    for integrator path; 8 for models by integrator whitted]."""
    min_throughput: float | None
    """Terminate reflection and refraction rays below this throughput, 0 to 1 [default: 1/512]."""
    transparent_shadows: bool | None
    """Path tracing: let all glass filter shadow rays in straight lines, which loses caustics."""
    bsdf: Literal["full", "spec"] | None
    """How metallic-roughness materials scatter in path-traced pictures [default: full]."""
    clamp_indirect: float | None
    """Path tracing: clamp what a sample gains at once from indirect light to this radiance, above 0 to 1e6 [default: no
    limit]."""
    filter: Literal["box", "tent", "gaussian", "blackman-harris", "mitchell"] | None
    """Reconstruction filter [default: the scene's, else box]."""
    filter_radius: float | None
    """Radius of the reconstruction filter, 0.01 to 16 [default: box 0.5, tent 1, mitchell 2, others 1.5]."""
    light_samples: float | None
    """Multiply the sample count of every area light by this, 0.001 to 1000 [default: the scene's, else 1]."""
    integrator: Literal["whitted", "path", "lecture", "normals", "depth", "ids", "uv", "heat", "samples"] | None
    """Integrator or debug view [default: the scene's, else path for models and whitted for scenes]."""
    triangle_test: Literal["plane", "moller-trumbore", "watertight"] | None
    """Ray–triangle intersection algorithm [default: watertight]."""
    offset: str | None
    """Origin of reflected, refracted and shadow rays: bound or fixed:EPS."""
    no_bvh: bool | None
    """Test every primitive for every ray instead of traversing the BVH: the same picture, but slow."""
    seed: int | None
    """Random seed; the same scene, settings and seed give the same picture [default: 0]."""
    crop: tuple[int, int, int, int] | list[int] | str | None
    """Render only columns X0 to X1-1 and rows Y0 to Y1-1, in pixels from the top left."""
    exposure: float | Literal["auto"] | None
    """Exposure: multiply radiance by 2^EV, -64 to 64 [default: the scene's, else 0; 0 for .exr and .hdr]."""
    tone: Literal["none", "aces", "agx", "reinhard", "neutral"] | None
    """Tone curve [default: the scene's, else for paths neutral in models, none in bare ones, agx in scenes; none for
    whitted, .exr, .hdr and debug views]."""
    transfer: Literal["srgb", "linear"] | None
    """Transfer function [default: the scene's, else srgb; srgb too where paths bring their curve to a scene for
    whitted; linear for .exr, .hdr and debug views]."""
    denoise: bool | None
    """Denoise the picture [default: that of models, as the scene says for others]; films and, with layers, the layer
    beauty keep the noise."""
    no_denoise: bool | None
    """Show the samples as they are, also of a model; samples 64 then has less noise."""
    camera: Choice | None
    """Camera of the scene, by its name or its number in `inspect`."""
    fov_y: float | None
    """Vertical field of view in degrees, 0.001 to 179.9; selects perspective projection."""
    orthographic: float | None
    """Orthographic projection with a view of this height, in scene units, 1e-9 to 1e9."""
    look_from: Numbers | None
    """Camera position, in scene units."""
    look_at: Numbers | None
    """Point at the centre of the picture, in scene units."""
    up: Numbers | None
    """Up direction of the camera; or with a letter the axis of a model that points up [default of models: z for .stl,
    else y]."""
    background: Numbers | None
    """Background colour: linear radiance, 0 or more per channel; or transparent."""
    section: Numbers | None
    """Cut away what lies beyond a plane: points p with X·p.x + Y·p.y + Z·p.z > OFFSET, or none."""
    strict: bool | None
    """Refuse a scene if anything in it would be skipped or repaired."""
    set: Mapping[str, Any] | Iterable[str] | str | None
    """Override a value of a native scene, such as camera.fov_y_deg=30 (repeatable)."""
    allow_dir: Iterable[Path] | Path | None
    """Allow the scene to read files from this folder as well as its own (repeatable)."""
    scene: Choice | None
    """Scene of a glTF model, by its name or number [default: the model's]."""
    clip: Choice | None
    """Clip of a glTF model to play, by its name or number [default: all that fit together]."""
    variant: Choice | None
    """Variant of a glTF model's materials, by its name or number [default: the model's]."""
    texture_limit: float | None
    """Halve pictures of textures and backgrounds until no side is longer than this, in pixels, which is reported
    [default: no limit; all pictures together take at most 2.75 GiB]."""
    environment: Path | Pixels | None
    """Replace the background: an equirectangular picture (.hdr, .exr, .png, .jpg, .webp), a built-in environment, which
    is noon, sunset, overcast, studio, ring or furnace, or a clear sky with the sun at this elevation, 0 to 90, and
    azimuth from -z towards +x, in degrees [default of sky: 45,-135]."""
    environment_strength: float | None
    """Factor on the radiance of the background, 0 to 1e6."""
    environment_rotation: float | None
    """Turn the picture of the background about +y by this angle in degrees, counter-clockwise seen from above."""
    fit: bool | None
    """Frame the model, whatever its own cameras show."""
    bare: bool | None
    """Add nothing to a model: no camera that frames it, no lights, no background, no ground, no tone curve."""
    no_lights: bool | None
    """Add no lamps to a model without lights, or with weak ones; its background still lights paths."""
    no_background: bool | None
    """Add no background to a model without lights, or with weak ones: it is black."""
    no_ground: bool | None
    """Add no ground to a model without lights, or with weak ones; background leaves it out too."""
    ground: Literal["surface", "shadow"] | None
    """The ground below a model: a surface, or only the shadow on it, with a transparent background [default: a surface
    below models without lights or with weak ones, if no background is given]."""
    adapter: Choice | None
    """GPU adapter, by its number in `doctor` or part of its name [default: the fastest]."""
    backend: Literal["vulkan", "metal", "dx12", "gl"] | None
    """Graphics API [default: the best available]."""
    memory_limit: int | None
    """Refuse scenes that need more GPU memory than this, in MiB."""
    count_rays: bool | None
    """Count the rays of each kind for the report, at a small cost in speed."""


class TurntableKeywords(TypedDict, total=False):
    """Keywords of `turntable`."""

    quality: int | None
    """Quality of JPEG frames and videos, 1 (smallest file) to 100 (best)."""
    frames_dir: Path | None
    """Folder for the frames of a video [default: OUT.frames beside it; none for `-`]."""
    keep_frames: bool | None
    """Keep the frames of a video after it is written, as frames_dir and encode_only do."""
    discard_frames: bool | None
    """Remove the frames after the video is written even with frames_dir or encode_only."""
    seconds: float | None
    """Duration of one turn, 0.01 to 10000."""
    fps: float | None
    """Frames per second, 0.01 to 1000."""
    axis: Numbers | None
    """Rotation axis and up direction: x, y, z or a vector."""
    elevation: float | None
    """Elevation of the camera above the model's centre in degrees, -89 to 89."""
    fov_y: float | None
    """Vertical field of view in degrees, 1 to 170."""
    margin: float | None
    """Empty margin around the model, as a fraction of the picture, 0 to 0.9."""
    clockwise: bool | None
    """Turn the model clockwise, seen from above."""
    background: Numbers | None
    """Background colour: linear radiance, 0 or more per channel."""
    section: Numbers | None
    """Cut away what lies beyond a plane: points p with X·p.x + Y·p.y + Z·p.z > OFFSET, or none."""
    shutter: float | tuple[float, float] | str | None
    """Shutter interval for motion blur [default: the model's, else 0]."""
    size: tuple[int, int] | list[int] | str | None
    """Width and height in pixels [default: the scene's, else 640x480; 800x600 for models]."""
    samples: int | None
    """Samples per pixel, 1 to 65536 [default: the scene's; 8 of models, which are denoised, also with more; else 64 for
    integrator path, 16 with a lens, an area light or motion blur; else 1]."""
    antialias: Literal["none", "stratified", "adaptive"] | None
    """Distribution of the samples within a pixel [default: stratified for more than one sample, else none]."""
    noise: float | None
    """Noise threshold of adaptive sampling, 0.000001 to 1 [default: the scene's, else 0.01]."""
    max_depth: int | None
    """Bounces after the first hit, 0 to 1000; 0 is local shading only [default: the scene's, else 5; 0 for .scene; 16
    for integrator path; 8 for models by integrator whitted]."""
    min_throughput: float | None
    """Terminate reflection and refraction rays below this throughput, 0 to 1 [default: 1/512]."""
    transparent_shadows: bool | None
    """Path tracing: let all glass filter shadow rays in straight lines, which loses caustics."""
    bsdf: Literal["full", "spec"] | None
    """How metallic-roughness materials scatter in path-traced pictures [default: full]."""
    clamp_indirect: float | None
    """Path tracing: clamp what a sample gains at once from indirect light to this radiance, above 0 to 1e6 [default: no
    limit]."""
    filter: Literal["box", "tent", "gaussian", "blackman-harris", "mitchell"] | None
    """Reconstruction filter [default: the scene's, else box]."""
    filter_radius: float | None
    """Radius of the reconstruction filter, 0.01 to 16 [default: box 0.5, tent 1, mitchell 2, others 1.5]."""
    light_samples: float | None
    """Multiply the sample count of every area light by this, 0.001 to 1000 [default: the scene's, else 1]."""
    integrator: Literal["whitted", "path", "lecture", "normals", "depth", "ids", "uv", "heat", "samples"] | None
    """Integrator or debug view [default: the scene's, else path for models and whitted for scenes]."""
    triangle_test: Literal["plane", "moller-trumbore", "watertight"] | None
    """Ray–triangle intersection algorithm [default: watertight]."""
    offset: str | None
    """Origin of reflected, refracted and shadow rays: bound or fixed:EPS."""
    no_bvh: bool | None
    """Test every primitive for every ray instead of traversing the BVH: the same picture, but slow."""
    seed: int | None
    """Random seed; the same scene, settings and seed give the same picture [default: 0]."""
    crop: tuple[int, int, int, int] | list[int] | str | None
    """Render only columns X0 to X1-1 and rows Y0 to Y1-1, in pixels from the top left."""
    exposure: float | Literal["auto"] | None
    """Exposure: multiply radiance by 2^EV, -64 to 64 [default: the scene's, else 0; 0 for .exr and .hdr]."""
    tone: Literal["none", "aces", "agx", "reinhard", "neutral"] | None
    """Tone curve [default: the scene's, else for paths neutral in models, none in bare ones, agx in scenes; none for
    whitted, .exr, .hdr and debug views]."""
    transfer: Literal["srgb", "linear"] | None
    """Transfer function [default: the scene's, else srgb; srgb too where paths bring their curve to a scene for
    whitted; linear for .exr, .hdr and debug views]."""
    denoise: bool | None
    """Denoise the picture [default: that of models, as the scene says for others]; films and, with layers, the layer
    beauty keep the noise."""
    no_denoise: bool | None
    """Show the samples as they are, also of a model; samples 64 then has less noise."""
    up: Literal["x", "y", "z"] | None
    """Axis of a model that points up: x, y or z [default: z for .stl, else y]."""
    strict: bool | None
    """Refuse a scene if anything in it would be skipped or repaired."""
    set: Mapping[str, Any] | Iterable[str] | str | None
    """Override a value of a native scene, such as camera.fov_y_deg=30 (repeatable)."""
    allow_dir: Iterable[Path] | Path | None
    """Allow the scene to read files from this folder as well as its own (repeatable)."""
    scene: Choice | None
    """Scene of a glTF model, by its name or number [default: the model's]."""
    clip: Choice | None
    """Clip of a glTF model to play, by its name or number [default: all that fit together]."""
    variant: Choice | None
    """Variant of a glTF model's materials, by its name or number [default: the model's]."""
    texture_limit: float | None
    """Halve pictures of textures and backgrounds until no side is longer than this, in pixels, which is reported
    [default: no limit; all pictures together take at most 2.75 GiB]."""
    environment: Path | Pixels | None
    """Replace the background: an equirectangular picture (.hdr, .exr, .png, .jpg, .webp), a built-in environment, which
    is noon, sunset, overcast, studio, ring or furnace, or a clear sky with the sun at this elevation, 0 to 90, and
    azimuth from -z towards +x, in degrees [default of sky: 45,-135]."""
    environment_strength: float | None
    """Factor on the radiance of the background, 0 to 1e6."""
    environment_rotation: float | None
    """Turn the picture of the background about +y by this angle in degrees, counter-clockwise seen from above."""
    fit: bool | None
    """Frame the model, whatever its own cameras show."""
    bare: bool | None
    """Add nothing to a model: no camera that frames it, no lights, no background, no ground, no tone curve."""
    no_lights: bool | None
    """Add no lamps to a model without lights, or with weak ones; its background still lights paths."""
    no_background: bool | None
    """Add no background to a model without lights, or with weak ones: it is black."""
    no_ground: bool | None
    """Add no ground to a model without lights, or with weak ones; background leaves it out too."""
    ground: Literal["surface", "shadow"] | None
    """The ground below a model: a surface, or only the shadow on it, with a transparent background [default: a surface
    below models without lights or with weak ones, if no background is given]."""
    adapter: Choice | None
    """GPU adapter, by its number in `doctor` or part of its name [default: the fastest]."""
    backend: Literal["vulkan", "metal", "dx12", "gl"] | None
    """Graphics API [default: the best available]."""
    memory_limit: int | None
    """Refuse scenes that need more GPU memory than this, in MiB."""
    count_rays: bool | None
    """Count the rays of each kind for the report, at a small cost in speed."""


class SheetKeywords(TypedDict, total=False):
    """Keywords of `sheet`."""

    quality: int | None
    """JPEG quality, 1 (smallest file) to 100 (best)."""
    size: int | None
    """Width and height of each view in pixels, 64 to 2048."""
    views: Iterable[Literal["front", "back", "left", "right", "top", "bottom", "front-right", "back-left"]] | str | None
    """The views and their order, separated by commas [default: all]."""
    background: Numbers | None
    """Background colour: linear radiance, 0 or more per channel."""
    section: Numbers | None
    """Cut away what lies beyond a plane: points p with X·p.x + Y·p.y + Z·p.z > OFFSET, or none."""
    samples: int | None
    """Samples per pixel, 1 to 65536 [default: the scene's; 8 of models, which are denoised, also with more; else 64 for
    integrator path, 16 with a lens, an area light or motion blur; else 1]."""
    antialias: Literal["none", "stratified", "adaptive"] | None
    """Distribution of the samples within a pixel [default: stratified for more than one sample, else none]."""
    noise: float | None
    """Noise threshold of adaptive sampling, 0.000001 to 1 [default: the scene's, else 0.01]."""
    max_depth: int | None
    """Bounces after the first hit, 0 to 1000; 0 is local shading only [default: the scene's, else 5; 0 for .scene; 16
    for integrator path; 8 for models by integrator whitted]."""
    min_throughput: float | None
    """Terminate reflection and refraction rays below this throughput, 0 to 1 [default: 1/512]."""
    transparent_shadows: bool | None
    """Path tracing: let all glass filter shadow rays in straight lines, which loses caustics."""
    bsdf: Literal["full", "spec"] | None
    """How metallic-roughness materials scatter in path-traced pictures [default: full]."""
    clamp_indirect: float | None
    """Path tracing: clamp what a sample gains at once from indirect light to this radiance, above 0 to 1e6 [default: no
    limit]."""
    filter: Literal["box", "tent", "gaussian", "blackman-harris", "mitchell"] | None
    """Reconstruction filter [default: the scene's, else box]."""
    filter_radius: float | None
    """Radius of the reconstruction filter, 0.01 to 16 [default: box 0.5, tent 1, mitchell 2, others 1.5]."""
    light_samples: float | None
    """Multiply the sample count of every area light by this, 0.001 to 1000 [default: the scene's, else 1]."""
    integrator: Literal["whitted", "path", "lecture", "normals", "depth", "ids", "uv", "heat", "samples"] | None
    """Integrator or debug view [default: the scene's, else path for models and whitted for scenes]."""
    triangle_test: Literal["plane", "moller-trumbore", "watertight"] | None
    """Ray–triangle intersection algorithm [default: watertight]."""
    offset: str | None
    """Origin of reflected, refracted and shadow rays: bound or fixed:EPS."""
    no_bvh: bool | None
    """Test every primitive for every ray instead of traversing the BVH: the same picture, but slow."""
    seed: int | None
    """Random seed; the same scene, settings and seed give the same picture [default: 0]."""
    exposure: float | Literal["auto"] | None
    """Exposure: multiply radiance by 2^EV, -64 to 64 [default: the scene's, else 0; 0 for .exr and .hdr]."""
    tone: Literal["none", "aces", "agx", "reinhard", "neutral"] | None
    """Tone curve [default: the scene's, else for paths neutral in models, none in bare ones, agx in scenes; none for
    whitted, .exr, .hdr and debug views]."""
    transfer: Literal["srgb", "linear"] | None
    """Transfer function [default: the scene's, else srgb; srgb too where paths bring their curve to a scene for
    whitted; linear for .exr, .hdr and debug views]."""
    denoise: bool | None
    """Denoise the picture [default: that of models, as the scene says for others]; films and, with layers, the layer
    beauty keep the noise."""
    no_denoise: bool | None
    """Show the samples as they are, also of a model; samples 64 then has less noise."""
    up: Literal["x", "y", "z"] | None
    """Axis of a model that points up: x, y or z [default: z for .stl, else y]."""
    strict: bool | None
    """Refuse a scene if anything in it would be skipped or repaired."""
    set: Mapping[str, Any] | Iterable[str] | str | None
    """Override a value of a native scene, such as camera.fov_y_deg=30 (repeatable)."""
    allow_dir: Iterable[Path] | Path | None
    """Allow the scene to read files from this folder as well as its own (repeatable)."""
    scene: Choice | None
    """Scene of a glTF model, by its name or number [default: the model's]."""
    clip: Choice | None
    """Clip of a glTF model to play, by its name or number [default: all that fit together]."""
    variant: Choice | None
    """Variant of a glTF model's materials, by its name or number [default: the model's]."""
    texture_limit: float | None
    """Halve pictures of textures and backgrounds until no side is longer than this, in pixels, which is reported
    [default: no limit; all pictures together take at most 2.75 GiB]."""
    environment: Path | Pixels | None
    """Replace the background: an equirectangular picture (.hdr, .exr, .png, .jpg, .webp), a built-in environment, which
    is noon, sunset, overcast, studio, ring or furnace, or a clear sky with the sun at this elevation, 0 to 90, and
    azimuth from -z towards +x, in degrees [default of sky: 45,-135]."""
    environment_strength: float | None
    """Factor on the radiance of the background, 0 to 1e6."""
    environment_rotation: float | None
    """Turn the picture of the background about +y by this angle in degrees, counter-clockwise seen from above."""
    fit: bool | None
    """Frame the model, whatever its own cameras show."""
    bare: bool | None
    """Add nothing to a model: no camera that frames it, no lights, no background, no ground, no tone curve."""
    no_lights: bool | None
    """Add no lamps to a model without lights, or with weak ones; its background still lights paths."""
    no_background: bool | None
    """Add no background to a model without lights, or with weak ones: it is black."""
    no_ground: bool | None
    """Add no ground to a model without lights, or with weak ones; background leaves it out too."""
    ground: Literal["surface", "shadow"] | None
    """The ground below a model: a surface, or only the shadow on it, with a transparent background [default: a surface
    below models without lights or with weak ones, if no background is given]."""
    adapter: Choice | None
    """GPU adapter, by its number in `doctor` or part of its name [default: the fastest]."""
    backend: Literal["vulkan", "metal", "dx12", "gl"] | None
    """Graphics API [default: the best available]."""
    memory_limit: int | None
    """Refuse scenes that need more GPU memory than this, in MiB."""
    count_rays: bool | None
    """Count the rays of each kind for the report, at a small cost in speed."""


class InspectKeywords(TypedDict, total=False):
    """Keywords of `inspect` and `RayQuery`."""

    up: Literal["x", "y", "z"] | None
    """Axis of a model that points up: x, y or z [default: z for .stl, else y]."""
    strict: bool | None
    """Refuse a scene if anything in it would be skipped or repaired."""
    set: Mapping[str, Any] | Iterable[str] | str | None
    """Override a value of a native scene, such as camera.fov_y_deg=30 (repeatable)."""
    allow_dir: Iterable[Path] | Path | None
    """Allow the scene to read files from this folder as well as its own (repeatable)."""
    scene: Choice | None
    """Scene of a glTF model, by its name or number [default: the model's]."""
    clip: Choice | None
    """Clip of a glTF model to play, by its name or number [default: all that fit together]."""
    variant: Choice | None
    """Variant of a glTF model's materials, by its name or number [default: the model's]."""
    texture_limit: float | None
    """Halve pictures of textures and backgrounds until no side is longer than this, in pixels, which is reported
    [default: no limit; all pictures together take at most 2.75 GiB]."""
    environment: Path | Pixels | None
    """Replace the background: an equirectangular picture (.hdr, .exr, .png, .jpg, .webp), a built-in environment, which
    is noon, sunset, overcast, studio, ring or furnace, or a clear sky with the sun at this elevation, 0 to 90, and
    azimuth from -z towards +x, in degrees [default of sky: 45,-135]."""
    environment_strength: float | None
    """Factor on the radiance of the background, 0 to 1e6."""
    environment_rotation: float | None
    """Turn the picture of the background about +y by this angle in degrees, counter-clockwise seen from above."""
    fit: bool | None
    """Frame the model, whatever its own cameras show."""
    bare: bool | None
    """Add nothing to a model: no camera that frames it, no lights, no background, no ground, no tone curve."""
    no_lights: bool | None
    """Add no lamps to a model without lights, or with weak ones; its background still lights paths."""
    no_background: bool | None
    """Add no background to a model without lights, or with weak ones: it is black."""
    no_ground: bool | None
    """Add no ground to a model without lights, or with weak ones; background leaves it out too."""
    ground: Literal["surface", "shadow"] | None
    """The ground below a model: a surface, or only the shadow on it, with a transparent background [default: a surface
    below models without lights or with weak ones, if no background is given]."""


class ConvertKeywords(TypedDict, total=False):
    """Keywords of `Scene.load`."""

    up: Literal["x", "y", "z"] | None
    """Axis of a model that points up: x, y or z [default: z for .stl, else y]."""
    strict: bool | None
    """Refuse a scene if anything in it would be skipped or repaired."""
    set: Mapping[str, Any] | Iterable[str] | str | None
    """Override a value of a native scene, such as camera.fov_y_deg=30 (repeatable)."""
    allow_dir: Iterable[Path] | Path | None
    """Allow the scene to read files from this folder as well as its own (repeatable)."""
    scene: Choice | None
    """Scene of a glTF model, by its name or number [default: the model's]."""
    clip: Choice | None
    """Clip of a glTF model to play, by its name or number [default: all that fit together]."""
    variant: Choice | None
    """Variant of a glTF model's materials, by its name or number [default: the model's]."""
    texture_limit: float | None
    """Halve pictures of textures and backgrounds until no side is longer than this, in pixels, which is reported
    [default: no limit; all pictures together take at most 2.75 GiB]."""
    environment: Path | Pixels | None
    """Replace the background: an equirectangular picture (.hdr, .exr, .png, .jpg, .webp), a built-in environment, which
    is noon, sunset, overcast, studio, ring or furnace, or a clear sky with the sun at this elevation, 0 to 90, and
    azimuth from -z towards +x, in degrees [default of sky: 45,-135]."""
    environment_strength: float | None
    """Factor on the radiance of the background, 0 to 1e6."""
    environment_rotation: float | None
    """Turn the picture of the background about +y by this angle in degrees, counter-clockwise seen from above."""
    fit: bool | None
    """Frame the model, whatever its own cameras show."""
    bare: bool | None
    """Add nothing to a model: no camera that frames it, no lights, no background, no ground, no tone curve."""
    no_lights: bool | None
    """Add no lamps to a model without lights, or with weak ones; its background still lights paths."""
    no_background: bool | None
    """Add no background to a model without lights, or with weak ones: it is black."""
    no_ground: bool | None
    """Add no ground to a model without lights, or with weak ones; background leaves it out too."""
    ground: Literal["surface", "shadow"] | None
    """The ground below a model: a surface, or only the shadow on it, with a transparent background [default: a surface
    below models without lights or with weak ones, if no background is given]."""
