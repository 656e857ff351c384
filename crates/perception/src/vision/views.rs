//! Pictures from cameras, from sensors at another resolution, and from a place from which all can be seen.

use nalgebra::{Point3, UnitQuaternion, Vector3};
use rendering::{Channels, Picture};

use super::sensors::sensor_shot;
use super::{Backdrop, ColourMode, Shot, Subjects, Vision};
use scene::sensor::{Camera, View};
use scene::{Handle, Kind, Object, ObjectFlags, Pose, Scene, SceneError, SceneResult};

/// From where a scene without a camera is seen: towards the middle of what is visible.
const USUAL_DIRECTION: [f64; 3] = [-1.0, -1.5, 1.2];
/// Free space around what is visible, as a factor.
const MARGIN: f64 = 1.1;
/// Radius of an empty scene, metres.
const EMPTY_RADIUS: f64 = 1.0;

impl Vision {
    /// The scene as a camera or a vision sensor sees it; without one from where all of it can be seen. `resolution` replaces the
    /// camera's own. Ids are handles of objects.
    ///
    /// # Errors
    /// When `from` is neither a camera nor a vision sensor.
    pub fn view(
        &mut self,
        scene: &Scene,
        from: Option<Handle>,
        resolution: Option<[u32; 2]>,
        channels: Channels,
    ) -> SceneResult<Picture> {
        let mut shot = shot(scene, from)?;
        if let Some(resolution) = resolution {
            shot.view.set_resolution(resolution.map(i64::from));
        }
        Ok(self.picture(scene, &shot, channels))
    }
}

/// The projection of a camera or vision sensor; without one of that from which the whole scene is seen.
///
/// # Errors
/// When `from` is neither a camera nor a vision sensor.
pub fn projection(scene: &Scene, from: Option<Handle>) -> SceneResult<View> {
    Ok(shot(scene, from)?.view)
}

/// From where a series of pictures is taken.
pub enum Viewpoint {
    /// A camera or vision sensor, wherever it is.
    Object(Handle),
    /// A place from which the whole scene could be seen at first.
    Place(Box<Shot>),
}

impl Viewpoint {
    /// A camera or vision sensor; without one a place from which the whole scene is seen now.
    ///
    /// # Errors
    /// When `from` is neither a camera nor a vision sensor.
    pub fn new(scene: &Scene, from: Option<Handle>) -> SceneResult<Self> {
        let shot = shot(scene, from)?;
        Ok(from.map_or_else(|| Self::Place(Box::new(shot)), Self::Object))
    }

    /// A place of one's own, from which the default camera looks at a point.
    pub fn looking(eye: [f64; 3], target: [f64; 3]) -> Self {
        let direction = Vector3::from(target) - Vector3::from(eye);
        let is_upright = direction.xy().norm() < 1e-6 * direction.norm();
        let up = if is_upright {
            Vector3::y()
        } else {
            Vector3::z()
        };
        let rotation = UnitQuaternion::face_towards(&direction, &up);
        let pose = Pose::from_parts(Vector3::from(eye).into(), rotation);
        let mut shot = camera_shot(None, pose, Camera::default().view);
        shot.view.clipping[1] = shot.view.clipping[1].max(4.0 * direction.norm());
        Self::Place(Box::new(shot))
    }

    /// Width and height of a vision sensor.
    pub fn resolution(&self, scene: &Scene) -> Option<[u32; 2]> {
        let Self::Object(handle) = self else {
            return None;
        };
        Some(
            scene
                .object(*handle)
                .ok()?
                .vision_sensor()
                .ok()?
                .view
                .resolution,
        )
    }

    /// What is seen from there now, in a picture of that width and height.
    ///
    /// # Errors
    /// When the object is gone.
    pub fn shot(&self, scene: &Scene, resolution: [u32; 2]) -> SceneResult<Shot> {
        let mut shot = match self {
            Self::Object(handle) => shot(scene, Some(*handle))?,
            Self::Place(shot) => (**shot).clone(),
        };
        shot.view.set_resolution(resolution.map(i64::from));
        Ok(shot)
    }
}

/// The first camera of a scene.
pub fn first_camera(scene: &Scene) -> Option<Handle> {
    scene
        .objects()
        .find(|object| matches!(object.kind, Kind::Camera(_)))
        .map(Object::handle)
}

fn shot(scene: &Scene, from: Option<Handle>) -> SceneResult<Shot> {
    let Some(handle) = from else {
        let mut shot = camera_shot(None, overview(scene), Camera::default().view);
        // As far as the scene reaches.
        shot.view.clipping[1] =
            shot.view.clipping[1].max(4.0 * shot.pose.translation.vector.norm());
        return Ok(shot);
    };
    match &scene.object(handle)?.kind {
        Kind::Camera(camera) => Ok(camera_shot(
            from,
            scene.world_pose(handle)?,
            camera.view.clone(),
        )),
        Kind::VisionSensor(sensor) => sensor_shot(scene, handle, sensor, None),
        _ => Err(SceneError::WrongType("camera")),
    }
}

fn camera_shot(viewer: Option<Handle>, pose: Pose, view: View) -> Shot {
    Shot {
        viewer,
        pose,
        view,
        subjects: Subjects::Visible,
        colour_mode: ColourMode::Lit { shadows: false },
        backdrop: Backdrop::Views,
        has_fog: true,
        has_specular: true,
        lit_by: None,
    }
}

/// A place from which all that is visible can be seen, with the default camera.
fn overview(scene: &Scene) -> Pose {
    let (centre, radius) = extent(scene);
    let direction = Vector3::from(USUAL_DIRECTION).normalize();
    let distance = MARGIN * radius / libm::sin(0.5 * Camera::default().view.angle);
    let rotation = UnitQuaternion::face_towards(&-direction, &Vector3::z());
    Pose::from_parts((centre + distance * direction).coords.into(), rotation)
}

/// A ball around all that is visible.
fn extent(scene: &Scene) -> (Point3<f64>, f64) {
    let mut corners: Vec<Point3<f64>> = Vec::new();
    for subject in Subjects::Visible.objects(scene, None) {
        let (Ok(object), Ok(pose)) = (
            scene.object(subject.handle),
            scene.world_pose(subject.handle),
        ) else {
            continue;
        };
        if object
            .object_property
            .contains(ObjectFlags::IGNORE_VIEW_FITTING)
        {
            continue;
        }
        let placed = outline(object).into_iter().map(|corner| pose * corner);
        corners.extend(placed.filter(|corner| corner.coords.iter().all(|c| c.is_finite())));
    }
    let Some(first) = corners.first() else {
        return (Point3::origin(), EMPTY_RADIUS);
    };
    let (low, high) = corners
        .iter()
        .fold((*first, *first), |(low, high), corner| {
            (low.inf(corner), high.sup(corner))
        });
    (
        nalgebra::center(&low, &high),
        (nalgebra::distance(&low, &high) / 2.0).max(1e-3),
    )
}

/// Points around what can be seen of an object, in its frame.
fn outline(object: &Object) -> Vec<Point3<f64>> {
    match &object.kind {
        Kind::OcTree(octree) => octree.voxels().map(|(centre, _)| centre.into()).collect(),
        Kind::PointCloud(cloud) => cloud
            .points
            .iter()
            .map(|point| point.position.into())
            .collect(),
        _ => {
            let bounds = object.bounding_box();
            let half = Vector3::from(bounds.size) / 2.0;
            let sign =
                |corner: usize, axis: usize| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
            let signs =
                (0..8).map(|corner| Vector3::from([0, 1, 2].map(|axis| sign(corner, axis))));
            signs
                .map(|signs| bounds.pose * Point3::from(half.component_mul(&signs)))
                .collect()
        }
    }
}
