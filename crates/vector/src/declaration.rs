//! What an environment consists of, as its author declares it.

use std::path::PathBuf;

use script::Options;
use simulator::ScriptKind;

/// An environment: a scene, and what is read and written in it.
#[derive(Debug, Clone)]
pub struct Declaration {
    /// The scene, model or script, as `swanilda run` takes it.
    pub scene: PathBuf,
    /// What a Lua file becomes.
    pub kind: ScriptKind,
    /// Seconds of a simulation step; None for the scene's.
    pub time_step: Option<f64>,
    /// How each simulator behaves. All begin with the same seed, so that they are the same until their first episode.
    pub options: Options,
    /// Read after each step, one after the other.
    pub observations: Vec<Quantity>,
    /// Written before each step, one after the other.
    pub actions: Vec<Action>,
    /// Read after each step beside the observations.
    pub infos: Vec<Quantity>,
    /// Pictures after each step.
    pub cameras: Vec<Camera>,
    /// A Lua expression of `o`, the observations, and `a`, the actions: lists of numbers. None: the reward is 0.
    pub reward: Option<String>,
    /// The same for the end of an episode: true or false.
    pub terminated: Option<String>,
    /// Lua statements that run once, before the first episode, where expressions see their variables.
    pub prepare: Option<String>,
    /// Lua statements at the beginning of each episode.
    pub begin: Option<String>,
    /// Actions after which an episode is truncated; 0 for never.
    pub max_steps: u64,
    /// Simulation steps for each action.
    pub steps_per_action: u64,
    /// What is different in each episode.
    pub variations: Vec<Variation>,
    /// How an episode begins.
    pub reset: Reset,
}

impl Declaration {
    /// A scene in which nothing is read or written, with episodes without end.
    pub fn new(scene: PathBuf, options: Options) -> Self {
        Self {
            scene,
            kind: ScriptKind::Customization,
            time_step: None,
            options,
            observations: Vec::new(),
            actions: Vec::new(),
            infos: Vec::new(),
            cameras: Vec::new(),
            reward: None,
            terminated: None,
            prepare: None,
            begin: None,
            max_steps: 0,
            steps_per_action: 1,
            variations: Vec::new(),
            reset: Reset::Either,
        }
    }
}

/// Numbers that are read in a scene. Objects are named by their paths.
#[derive(Debug, Clone, PartialEq)]
pub enum Quantity {
    /// Position of a joint, metres or radians.
    JointPosition(String),
    /// Velocity of a joint, m/s or rad/s.
    JointVelocity(String),
    /// Force or torque of a joint's motor, N or N m.
    JointForce(String),
    /// Position of an object in the world, metres.
    Position(String),
    /// Orientation of an object in the world: x, y, z, w.
    Quaternion(String),
    /// Linear and angular velocity of an object, m/s and rad/s.
    Velocity(String),
    /// A property of an object.
    Property(String, String),
    /// What a global function of the script at that path returns.
    Function(String, String),
    /// A Lua expression.
    Expression(String),
}

/// Numbers that are written in a scene.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// Target position of a joint's motor, metres or radians; makes it a position motor.
    TargetPosition(String),
    /// Target velocity of a joint's motor, m/s or rad/s; makes it a velocity motor.
    TargetVelocity(String),
    /// Force or torque of a joint's motor, N or N m.
    TargetForce(String),
    /// A property of an object that is one number.
    Property(String, String),
    /// A global function of the script at that path, called with the number.
    Function(String, String),
    /// A Lua statement, in which the number is `x`.
    Statement(String),
}

/// Pictures of a camera or vision sensor.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Camera {
    /// Its path.
    pub path: String,
    /// Width and height, pixels; None for its own.
    pub resolution: Option<[u32; 2]>,
    /// Whether there is a picture after each step; otherwise only where [`Vector::draw`](crate::Vector::draw) is called.
    pub each_step: bool,
}

/// Something that is drawn anew for each episode, between two bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct Variation {
    /// What changes.
    pub target: Target,
    /// The least values, one for each number of the target, or one for all.
    pub low: Vec<f64>,
    /// The largest ones.
    pub high: Vec<f64>,
    /// What the drawn numbers mean.
    pub scale: Scale,
    /// How likely the values between the bounds are.
    pub distribution: Distribution,
}

/// What a variation changes.
#[derive(Debug, Clone, PartialEq)]
pub enum Target {
    /// A property of an object, of one number or several.
    Property(String, String),
    /// The position of an object in its parent's frame, metres.
    Position(String),
    /// Its orientation in its parent's frame, Euler angles in radians.
    Orientation(String),
    /// The mass of a shape, kg; its inertia changes as much.
    Mass(String),
    /// Friction of a shape.
    Friction(String),
    /// Actions act so many steps later.
    ActionDelay,
    /// A Lua statement, in which the number is `x`.
    Statement(String),
}

/// What the numbers of a variation mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// They are the values.
    Absolute,
    /// They are added to the values of the scene.
    Offset,
    /// They are factors of the values of the scene.
    Factor,
}

/// How likely the numbers between the bounds are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Distribution {
    /// All the same.
    Uniform,
    /// The logarithms all the same; bounds are above 0.
    LogUniform,
}

/// How an episode begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reset {
    /// The memory of the simulator becomes what it was when the simulation had just started.
    Snapshot,
    /// The simulation is stopped and started.
    Start,
    /// With a snapshot, or with a start where something is open that no snapshot reaches, such as a script in Python.
    Either,
}
