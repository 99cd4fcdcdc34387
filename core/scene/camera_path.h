// Moving cameras. The camera of a frame depends on the frame's number alone: no error adds up, and
// any frame can be asked for, in any order.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace restlab {

class ConfigTable;  // core/config.h

// Kinds of paths; the member of CameraPath that each needs describes it. Angles are right-handed
// about their axis: seen from above, a camera that orbits or turns about the scene's up by a
// positive angle does so anticlockwise.
enum class CameraPathKind { still, orbit, dolly, pan, cut, back, keyframes };

// The axis that a path turns about and that is upright on it: the scene's up (sceneUp), the up of
// the camera with which the path starts, or an axis of the world.
enum class CameraAxis { scene, camera, x, y, z };

// Where the camera is at one frame.
struct CameraKeyframe {
  uint32_t frame = 0;
  // A camera of the scene, by name or index; or, where this is empty, a camera at `positionW` that
  // looks at `targetW`, upright (its right is horizontal). Metres.
  std::string camera;
  glm::dvec3 positionW{0.0}, targetW{0.0};
  // Radians, vertical; absent: that of the camera, or of the one that the path starts with.
  std::optional<double> yfov;
  std::string place;  // starts errors: "suite.toml:4:1"
};

struct CameraPath {
  CameraPathKind kind = CameraPathKind::still;
  // orbit: the camera turns about the vertical through the target as if both were one piece: what
  // is on that axis stays where it is in the image, and the distance to it what it is.
  // pan: the camera turns where it stands.
  double degreesPerFrame = 0.0;
  // dolly: the camera walks along its view; negative: backwards.
  double metresPerFrame = 0.0;
  // orbit, cut by an angle: absent is the point that the camera looks at (pointLookedAt).
  std::optional<glm::dvec3> targetW;
  // All kinds that turn.
  CameraAxis about = CameraAxis::scene;
  // cut: from `cutFrame` on another camera stands still: one of the scene, by name or index, or,
  // where `cutCamera` is empty, the same one after an orbit by `cutDegrees`.
  uint32_t cutFrame = 0;
  std::string cutCamera;
  double cutDegrees = 0.0;
  // back: from `leaveFrame` until `cutFrame` the camera stands turned by `cutDegrees`;
  // before and after it is the scene's own: a cut whose reference is that of the still camera.
  uint32_t leaveFrame = 0;
  // keyframes: in the order of their frames. At its frame the camera is exactly that of the
  // keyframe; before the first and after the last it stands still. In between positions and fields
  // of view (angles; an orthographic camera's extents) are linear in the frame. Between two
  // keyframes with targets the target is linear too, and the camera upright: while it walks it
  // keeps looking at a target that both name. Otherwise it turns evenly, the shorter way round.
  std::vector<CameraKeyframe> keyframes;
  std::string place;  // starts errors; "": the path's kind does
};

// A path in a scene: names looked up, targets found.
struct CameraMotion {
  CameraPath path;
  SceneCamera start, afterCut;
  glm::dvec3 upW{0.0, 1.0, 0.0};        // unit; of path.about
  glm::dvec3 targetW{0.0};              // of an orbit
  std::vector<SceneCamera> keyCameras;  // of path.keyframes
};

// The path that starts with the scene's camera of that index. Throws Error (badUsage) at the place
// of what is wrong: unknown cameras, keyframes out of order, keyframes of perspective and
// orthographic cameras in one path, targets in, straight above or straight below the camera.
CameraMotion resolveCameraPath(const CameraPath& path, const Scene& scene, uint32_t camera);

// The camera of a frame, counted from 0. Its name and aspect ratio are those of the first frame's
// camera. Frame 0 of an orbit, dolly or pan, and every frame in which an angle has come round to a
// multiple of 360 degrees, is that camera to the last bit. Throws Error (badUsage) where keyframes
// lead the camera through its target, or straight above or below it.
SceneCamera cameraAt(const CameraMotion& motion, uint32_t frame);

// The axis of the world that is up by this camera, unit: +Y, as glTF has it, unless the camera's up
// lies more than 60 degrees off it and within 45 degrees of +Z. A scene whose files have another
// up than glTF shows it in nothing but its cameras.
glm::dvec3 sceneUp(const SceneCamera& camera);

// Lists faults of the views of frames 0 .. `frames` - 1, in lines, each kind once with its first
// frame: the camera walks through a surface; stands inside a body; stands nearer to a surface than
// its near distance; ends before a surface that fills its view. `scene` has the surfaces, in the
// metres of the path.
std::vector<std::string> cameraPathWarnings(const Scene& scene, const CameraMotion& motion,
                                            uint32_t frames);
// The same of a camera that stands still.
std::vector<std::string> cameraWarnings(const Scene& scene, const SceneCamera& camera);

// The first surface on the axis of the view, whatever its material and whichever side it shows.
// Where there is none: the point of the axis nearest to the middle of the scene's bounds, or, where
// that lies behind the camera, as far ahead as the bounds are large (1 m where they are empty).
glm::dvec3 pointLookedAt(const Scene& scene, const SceneCamera& camera);

// A path from a table such as { kind = "orbit", degrees_per_frame = 0.5 }; docs/manual.md lists the
// keys. Throws Error (badUsage) with place. Unknown keys are errors, but for those that the caller
// has asked for before.
CameraPath parseCameraPath(const ConfigTable& table);

// The value of the key `camera`, which is there: a name, or an index as a number or a string.
// Throws Error (badUsage) where it is empty or neither.
std::string readCameraName(const ConfigTable& table);

// The frame from which on the view stands still: 0, or that of the cut; nothing where it keeps
// moving.
std::optional<uint32_t> firstStillFrame(const CameraPath& path);

}  // namespace restlab
