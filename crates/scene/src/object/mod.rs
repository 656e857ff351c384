//! A scene object: the common part, and the part of its type.

pub mod assembly;
pub mod dummy;
pub mod flags;
pub mod handle;
pub(crate) mod identity;
pub mod movement;
pub(crate) mod objects;
pub mod script_object;
pub mod tendon;
pub mod viewers;

use assembly::Assembly;
use dummy::Dummy;
use flags::{DynamicFlags, Layers, ModelFlags, ObjectFlags, SpecialFlags};
use geometry::pose::velocity;
use script_object::{ExecutionPriority, ScriptObject};
use viewers::Viewers;

use crate::appearance::colour::{Colour, SECOND_COLOUR};
use crate::graph::Graph;
use crate::joint::Joint;
use crate::path_object::PathObject;
use crate::pose::world::PlaceInWorld;
use crate::sensor::force_sensor::ForceSensor;
use crate::sensor::{Camera, Light, ProximitySensor, View, VisionSensor};
use crate::shape::Shape;
use crate::simulation::restore::InitialState;
use crate::voxels::octree::OcTree;
use crate::voxels::point_cloud::PointCloud;
use crate::{CustomData, Handle, InertValues, Movement, Pose, SceneError, SceneResult, Uid};

/// A scene object.
#[derive(Debug, Clone)]
pub struct Object {
    pub(crate) handle: Handle,
    pub(crate) uid: Uid,
    pub(crate) alias: String,
    /// The name that functions from before aliases see, unique in the scene.
    pub(crate) old_name: String,
    pub(crate) parent: Option<Handle>,
    pub(crate) children: Vec<Handle>,
    /// Rises along the list of children that the object is in.
    pub(crate) rank: i64,
    /// In the parent's full frame (its moving side, for joints and force sensors).
    pub(crate) pose: Pose,
    pub(crate) place: PlaceInWorld,
    /// Display and selection.
    pub object_property: ObjectFlags,
    /// How sensors and calculations treat it.
    pub special_property: SpecialFlags,
    /// [`ModelFlags::NOT_MODEL`] for objects that are no model base.
    pub model_property: ModelFlags,
    /// The visibility layers it is on.
    pub layer: Layers,
    /// Of the body; shapes have theirs in their meshes.
    pub colour: Colour,
    /// Of the other part of joints and force sensors.
    pub(crate) second_colour: Colour,
    /// How a user may move it.
    pub movement: Movement,
    /// The cameras and vision sensors that see it.
    pub viewers: Viewers,
    /// Number of the colour in the tree, -1 for none. Kept for scripts.
    pub hierarchy_colour: i64,
    /// Members of one collection whose numbers differ by one do not collide with each other.
    pub self_collision_indicator: i64,
    /// Stays with the object when it is saved.
    pub persistent_uid: String,
    /// Shared with its copies.
    pub dna: Vec<u8>,
    /// Product of all factors it was scaled by.
    pub size_factor: f64,
    /// Numbers of scripts that are scaled with the object, for each axis.
    pub size_values: [f64; 3],
    /// Order among siblings, for scripts.
    pub priority: ExecutionPriority,
    /// Lasting named values of scripts; they are saved.
    pub custom_data: CustomData,
    /// Named values that last as long as the scripts that set them; they are not saved.
    pub signals: CustomData,
    /// Values that have no effect here, as scripts set them.
    pub inert: InertValues,
    /// How it connects to other models.
    pub assembly: Assembly,
    /// Settings of renderers and the like, such as `povray {...} openGL3 {...}`.
    pub extension_string: String,
    /// The same of its colour; meshes have their own.
    pub colour_extension: String,
    /// Parameters of the old parameter dialog: name and value as text.
    pub user_params: Vec<(String, String)>,
    /// Tagged lists of handles: `(tag, handles)`; -1 stands for an object that is gone.
    pub references: crate::ReferenceLists,
    /// Lists that copies keep unchanged: they refer to the same objects.
    pub original_references: crate::ReferenceLists,
    /// Aspects of this object that the physics simulates.
    pub dynamic_flag: DynamicFlags,
    /// Requests that the physics rebuilds this object.
    pub dynamics_reset: bool,
    /// World poses at the last two sensing parts of a step, for the measured velocity.
    pub measured: MeasuredVelocity,
    /// The state to restore when the simulation ends.
    pub(crate) initial: Option<Box<InitialState>>,
    /// Type and data of that type.
    pub kind: Kind,
}

/// How an object moved between the last two measurements: the result of `sim.getObjectVelocity`. It is computed when it is read, since most is not.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MeasuredVelocity {
    /// World pose at the last measurement; None before the first one.
    pub(crate) previous: Option<Pose>,
    /// The world pose at the measurement before, seconds before; None when the object has not moved since.
    pub(crate) from: Option<(Pose, f64)>,
}

impl MeasuredVelocity {
    /// Velocity of the origin, m/s, world axes.
    pub fn linear(&self) -> [f64; 3] {
        self.between(velocity::linear_velocity)
    }

    /// Euler triple of the increment in the object's previous frame, over the step, rad/s.
    pub fn euler_rate(&self) -> [f64; 3] {
        self.turning(velocity::angular_velocity_euler)
    }

    /// Axis times angle over the step, rad/s, world axes.
    pub fn angular(&self) -> [f64; 3] {
        self.turning(velocity::angular_velocity_axis)
    }

    /// Whether both have the same velocity, whatever the pose.
    pub(crate) fn same_velocity(&self, other: &Self) -> bool {
        self.linear() == other.linear() && self.angular() == other.angular()
    }

    /// A velocity of rotation: exactly zero without one, whatever the arithmetic of rotations.
    fn turning(&self, velocity: fn(&Pose, &Pose, f64) -> [f64; 3]) -> [f64; 3] {
        self.between(|before, now, dt| {
            if before.rotation == now.rotation {
                return [0.0; 3];
            }
            velocity(before, now, dt)
        })
    }

    fn between(&self, velocity: impl Fn(&Pose, &Pose, f64) -> [f64; 3]) -> [f64; 3] {
        let moved = self.previous.as_ref().zip(self.from.as_ref());
        moved.map_or([0.0; 3], |(now, (before, dt))| velocity(before, now, *dt))
    }
}

/// The type of an object with the data of that type.
#[derive(Debug, Clone)]
pub enum Kind {
    /// A rigid body with meshes.
    Shape(Box<Shape>),
    /// A joint.
    Joint(Box<Joint>),
    /// A recorder of data streams.
    Graph(Box<Graph>),
    /// A camera.
    Camera(Box<Camera>),
    /// A frame.
    Dummy(Dummy),
    /// A sensor of the distance to what is in its volume.
    ProximitySensor(Box<ProximitySensor>),
    /// A path of V-REP.
    Path(Box<PathObject>),
    /// A sensor of images and depths.
    VisionSensor(Box<VisionSensor>),
    /// A rigid connection that measures force and torque.
    ForceSensor(Box<ForceSensor>),
    /// A light.
    Light(Box<Light>),
    /// A set of voxels.
    OcTree(Box<OcTree>),
    /// A set of points.
    PointCloud(Box<PointCloud>),
    /// A script.
    Script(Box<ScriptObject>),
}

impl Kind {
    /// `sim.sceneobject_*`.
    pub fn type_number(&self) -> i64 {
        match self {
            Self::Shape(_) => 0,
            Self::Joint(_) => 1,
            Self::Graph(_) => 2,
            Self::Camera(_) => 3,
            Self::Dummy(_) => 4,
            Self::ProximitySensor(_) => 5,
            Self::Path(_) => 8,
            Self::VisionSensor(_) => 9,
            Self::ForceSensor(_) => 12,
            Self::Light(_) => 13,
            Self::OcTree(_) => 15,
            Self::PointCloud(_) => 16,
            Self::Script(_) => 17,
        }
    }

    fn default_layer(&self) -> Layers {
        match self {
            Self::Shape(_) => Layers::SHAPES,
            Self::Joint(_) => Layers::JOINTS,
            Self::Dummy(_) => Layers::DUMMIES,
            Self::ProximitySensor(_) | Self::VisionSensor(_) | Self::ForceSensor(_) => {
                Layers::SENSORS
            }
            Self::Camera(_) | Self::Light(_) => Layers::CAMERAS_AND_LIGHTS,
            Self::Graph(_) => Layers::GRAPHS,
            Self::OcTree(_) | Self::PointCloud(_) => Layers::VOXELS,
            Self::Path(_) => Layers::PATHS,
            Self::Script(_) => Layers::SCRIPTS,
        }
    }

    /// Scripts do not count for the box of a model.
    fn default_object_property(&self) -> ObjectFlags {
        match self {
            Self::Script(_) => ObjectFlags::SELECTABLE | ObjectFlags::HIDE_FROM_MODEL_BOX,
            _ => ObjectFlags::SELECTABLE,
        }
    }

    /// Collidable, measurable, detectable and renderable for what has a surface, nothing otherwise.
    fn default_special_property(&self) -> SpecialFlags {
        match self {
            Self::Shape(_) | Self::OcTree(_) | Self::PointCloud(_) => {
                SpecialFlags::COLLIDABLE
                    | SpecialFlags::MEASURABLE
                    | SpecialFlags::DETECTABLE
                    | SpecialFlags::RENDERABLE
            }
            _ => SpecialFlags::empty(),
        }
    }
}

impl Object {
    pub(crate) fn new(handle: Handle, uid: Uid, alias: &str, kind: Kind) -> Self {
        Self {
            handle,
            uid,
            alias: alias.to_owned(),
            old_name: alias.to_owned(),
            parent: None,
            children: Vec::new(),
            rank: 0,
            pose: Pose::identity(),
            place: PlaceInWorld::default(),
            object_property: kind.default_object_property(),
            special_property: kind.default_special_property(),
            model_property: ModelFlags::NOT_MODEL,
            layer: kind.default_layer(),
            colour: kind.default_colour(),
            second_colour: SECOND_COLOUR,
            movement: Movement::default(),
            viewers: Viewers::All,
            hierarchy_colour: -1,
            self_collision_indicator: 0,
            persistent_uid: String::new(),
            dna: Vec::new(),
            size_factor: 1.0,
            size_values: [1.0; 3],
            priority: ExecutionPriority::Normal,
            custom_data: CustomData::default(),
            signals: CustomData::default(),
            inert: InertValues::default(),
            assembly: Assembly::default(),
            extension_string: String::new(),
            colour_extension: String::new(),
            user_params: Vec::new(),
            references: Vec::new(),
            original_references: Vec::new(),
            dynamic_flag: DynamicFlags::empty(),
            dynamics_reset: false,
            measured: MeasuredVelocity::default(),
            initial: None,
            kind,
        }
    }

    /// How scripts and objects refer to it.
    pub fn handle(&self) -> Handle {
        self.handle
    }

    /// Its identifier, never given to another object of the session.
    pub fn uid(&self) -> Uid {
        self.uid
    }

    /// Its name, which other objects may share.
    pub fn alias(&self) -> &str {
        &self.alias
    }

    /// The name functions from before aliases see.
    pub fn old_name(&self) -> &str {
        &self.old_name
    }

    /// The object it is attached to; None for a root.
    pub fn parent(&self) -> Option<Handle> {
        self.parent
    }

    /// The objects attached to it, in order.
    pub fn children(&self) -> &[Handle] {
        &self.children
    }

    /// Pose in the parent's full frame.
    pub fn pose(&self) -> Pose {
        self.pose
    }

    /// Whether this is a `sim.sceneobject_*`; every object is a `sim.handle_all`.
    pub fn is_of_type(&self, object_type: i64) -> bool {
        object_type == crate::special::ALL || object_type == self.kind.type_number()
    }

    /// Whether it is the base of a model.
    pub fn is_model(&self) -> bool {
        !self.model_property.contains(ModelFlags::NOT_MODEL)
    }

    /// Makes it a model base with these flags, or with all of [`ModelFlags::NOT_MODEL`] no model base.
    pub fn set_model_property(&mut self, flags: ModelFlags) {
        self.model_property = if flags.contains(ModelFlags::NOT_MODEL) {
            ModelFlags::NOT_MODEL
        } else {
            flags
        };
    }

    /// From the object's frame to the frame its children live in.
    pub fn intrinsic_pose(&self) -> Option<Pose> {
        match &self.kind {
            Kind::Joint(joint) => Some(joint.intrinsic_pose()),
            Kind::ForceSensor(sensor) => sensor.error,
            _ => None,
        }
    }
}

impl Object {
    /// What a camera or a vision sensor sees, or the error scripts see.
    pub fn view(&self) -> SceneResult<&View> {
        match &self.kind {
            Kind::Camera(camera) => Ok(&camera.view),
            Kind::VisionSensor(sensor) => Ok(&sensor.view),
            _ => Err(SceneError::WrongType("camera")),
        }
    }

    /// What a camera or a vision sensor sees, or the error scripts see.
    pub fn view_mut(&mut self) -> SceneResult<&mut View> {
        match &mut self.kind {
            Kind::Camera(camera) => Ok(&mut camera.view),
            Kind::VisionSensor(sensor) => Ok(&mut sensor.view),
            _ => Err(SceneError::WrongType("camera")),
        }
    }
}

macro_rules! kind_access {
    ($($get:ident, $get_mut:ident, $variant:ident, $ty:ty, $word:literal;)*) => {
        impl Object {
            $(
                #[doc = concat!("The ", $word, ", or the error scripts see.")]
                pub fn $get(&self) -> SceneResult<&$ty> {
                    match &self.kind { Kind::$variant(data) => Ok(data), _ => Err(SceneError::WrongType($word)) }
                }

                #[doc = concat!("The ", $word, ", or the error scripts see.")]
                pub fn $get_mut(&mut self) -> SceneResult<&mut $ty> {
                    match &mut self.kind { Kind::$variant(data) => Ok(data), _ => Err(SceneError::WrongType($word)) }
                }
            )*
        }
    };
}

kind_access! {
    shape, shape_mut, Shape, Shape, "shape";
    joint, joint_mut, Joint, Joint, "joint";
    graph, graph_mut, Graph, Graph, "graph";
    camera, camera_mut, Camera, Camera, "camera";
    dummy, dummy_mut, Dummy, Dummy, "dummy";
    proximity_sensor, proximity_sensor_mut, ProximitySensor, ProximitySensor, "proximity sensor";
    path, path_mut, Path, PathObject, "path";
    vision_sensor, vision_sensor_mut, VisionSensor, VisionSensor, "vision sensor";
    force_sensor, force_sensor_mut, ForceSensor, ForceSensor, "force sensor";
    light, light_mut, Light, Light, "light";
    octree, octree_mut, OcTree, OcTree, "octree";
    point_cloud, point_cloud_mut, PointCloud, PointCloud, "point cloud";
    script, script_mut, Script, ScriptObject, "script";
}
