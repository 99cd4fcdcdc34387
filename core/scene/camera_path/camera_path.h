// Moving cameras. The camera of a frame depends only on the frame's number: no error accumulates,
// and any frame can be asked for, in any order.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace restlab {

class ConfigTable;  // core/base/config.h

// Kinds of paths; the members of CameraPath describe them. Angles are right-handed about their
// axis: seen from above, a camera that orbits or turns about the scene's up by a positive angle
// does so anticlockwise.
enum class CameraPathKind { still, orbit, dolly, pan, cut, back, keyframes };

// Axis that a path turns about and that keyframed cameras are upright on: the scene's up (sceneUp),
// the up of the path's first camera, or a world axis.
enum class CameraAxis { scene, camera, x, y, z };

// Camera at one frame.
struct CameraKeyframe {
  uint32_t frame = 0;
  // Camera of the scene, by name or index. If empty: a camera at `positionW` that looks at
  // `targetW`, upright (its right is horizontal). Metres.
  std::string camera;
  glm::dvec3 positionW{0.0}, targetW{0.0};
  // Vertical field of view, radians. Absent: that of the named camera, or of the path's first
  // camera.
  std::optional<double> yfov;
  std::string place;  // prefix of errors: "suite.toml:4:1"
};

struct CameraPath {
  CameraPathKind kind = CameraPathKind::still;
  // orbit: the camera turns about the vertical through the target. Points on that axis keep their
  // place in the image and their distance.
  // pan: the camera turns in place.
  double degreesPerFrame = 0.0;
  // dolly: the camera moves along its view; negative: backwards.
  double metresPerFrame = 0.0;
  // Target of orbits and of cuts by an angle. Absent: the point looked at (pointLookedAt).
  std::optional<glm::dvec3> targetW;
  // Axis of all kinds that turn.
  CameraAxis about = CameraAxis::scene;
  // cut: from `cutFrame` on the view is that of another camera, which stands still: a camera of the
  // scene, by name or index, or, if `cutCamera` is empty, the same camera after an orbit by
  // `cutDegrees`.
  uint32_t cutFrame = 0;
  std::string cutCamera;
  double cutDegrees = 0.0;
  // back: from `leaveFrame` until `cutFrame` the camera stands turned by `cutDegrees`; in all other
  // frames it is the scene's own camera. The return is a cut whose reference is that of the still
  // camera.
  uint32_t leaveFrame = 0;
  // keyframes: in the order of their frames. At a keyframe's frame the camera is exactly the
  // keyframe's; before the first and after the last keyframe it stands still. In between, positions
  // and fields of view (angles; an orthographic camera's extents) are linear in the frame. Between
  // two keyframes with targets the target is linear too, and the camera upright: a moving camera
  // keeps looking at a target that both keyframes name. Otherwise the camera turns evenly, the
  // shorter way round.
  std::vector<CameraKeyframe> keyframes;
  std::string place;  // prefix of errors; "" becomes "camera path"
};

// A path resolved in a scene: cameras looked up, targets found.
struct CameraMotion {
  CameraPath path;
  SceneCamera start, afterCut;
  glm::dvec3 upW{0.0, 1.0, 0.0};        // unit axis, from path.about
  glm::dvec3 targetW{0.0};              // target of an orbit
  std::vector<SceneCamera> keyCameras;  // one per keyframe of `path`
};

// Resolves a path that starts with the scene camera of that index. Throws Error (badUsage), with
// the place of the fault, for: unknown cameras; keyframes out of order; perspective and
// orthographic keyframes in one path; targets in, straight above or straight below the camera.
CameraMotion resolveCameraPath(const CameraPath& path, const Scene& scene, uint32_t camera);

// Camera of a frame, counted from 0. Name and aspect ratio are those of the first frame's camera.
// Frame 0 of an orbit, dolly or pan, and every frame whose angle is a multiple of 360 degrees, is
// that camera to the last bit. Throws Error (badUsage) if keyframes lead the camera through its
// target, or straight above or below it.
SceneCamera cameraAt(const CameraMotion& motion, uint32_t frame);

// World axis that is up, judged by the camera; unit. The result is +Y, as in glTF, unless the
// camera's up is more than 60 degrees off +Y and within 45 degrees of +Z. Only the cameras of a
// scene show that its files use another up than glTF.
glm::dvec3 sceneUp(const SceneCamera& camera);

// Lists faults of the views of frames 0 .. `frames` - 1, one line per kind with its first frame:
// the camera moves through a surface; stands inside a body; is closer to a surface than its near
// distance; ends in front of a surface that fills its view. `scene` provides the surfaces, in the
// metres of the path.
std::vector<std::string> cameraPathWarnings(const Scene& scene, const CameraMotion& motion,
                                            uint32_t frames);
// Lists the same faults for a camera that stands still.
std::vector<std::string> cameraWarnings(const Scene& scene, const SceneCamera& camera);

// Finds the first surface on the view axis, whatever its material and facing. If there is none: the
// point of the axis nearest to the middle of the scene's bounds, or, if that lies behind the
// camera, a point as far ahead as the bounds are large (1 m if they are empty).
glm::dvec3 pointLookedAt(const Scene& scene, const SceneCamera& camera);

// Parses a path from a table such as { kind = "orbit", degrees_per_frame = 0.5 }; docs/manual.md
// lists the keys. Throws Error (badUsage) with place. Unknown keys are errors, except keys that the
// caller has read before.
CameraPath parseCameraPath(const ConfigTable& table);

// Reads the key `camera`, which must be present: a name, or an index as a number or a string.
// Throws Error (badUsage) if it is empty or of another type.
std::string readCameraName(const ConfigTable& table);

// First frame from which on the view stands still: 0, or the frame of the cut; nullopt if it keeps
// moving.
std::optional<uint32_t> firstStillFrame(const CameraPath& path);

}  // namespace restlab
