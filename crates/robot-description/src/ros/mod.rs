//! What a robot has to do with ROS 2: its sensors and controllers, as tags of its description say, or parameters of ros2_control (YAML), or a TOML file.
//!
//! All of them become the same [`Part`]s. What is not understood is a warning with its line.

mod controllers;
mod defaults;
mod finish;
mod gazebo;
mod notes;
mod plugins;
mod rules;
mod schema;
mod tags;
mod toml;
mod tree;
mod yaml;

use std::collections::BTreeMap;

pub use controllers::of_yaml;
pub use tags::{of_sdf, of_urdf};
pub use toml::of_toml;

use crate::model::Robot;
use crate::report::Parsed;
use crate::xml::short;
use notes::Notes;

/// What a robot publishes and is told by.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Interface {
    /// Before its topics, if it is said.
    pub namespace: Option<String>,
    /// The object that is the robot, as scripts name it, if it is said.
    pub model: Option<String>,
    /// Sensors and controllers, in the order of the file.
    pub parts: Vec<Part>,
    /// What joints may be told.
    pub commands: Vec<Command>,
    /// Files with parameters of controllers, as the description names them, with their lines.
    pub parameter_files: Vec<(String, u32)>,
}

/// What a joint may be told.
#[derive(Debug, Clone, PartialEq)]
pub struct Command {
    /// The joint.
    pub joint: String,
    /// `position`, `velocity` or `effort`; empty where only the state is read.
    pub interface: String,
    /// Bounds of what it is told.
    pub range: [Option<f64>; 2],
    /// Where the joint is at first, if it is said.
    pub initial: Option<f64>,
    /// Its line, from 1.
    pub line: u32,
}

/// A sensor or a controller.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// What it does.
    pub kind: PartKind,
    /// Its name.
    pub name: String,
    /// What it is told, by the names of the parameters of ros2_control, or those of docs/ROS.md.
    pub values: BTreeMap<String, Value>,
    /// Its line, from 1.
    pub line: u32,
}

/// What a part does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PartKind {
    /// Measures distances in many directions.
    Lidar,
    /// Takes pictures, with or without depths.
    Camera,
    /// Measures rotation and acceleration.
    Imu,
    /// Turns two sides of wheels.
    DiffDrive,
    /// Moves joints along trajectories.
    Trajectory,
    /// Passes numbers to joints.
    Forward,
    /// Publishes states of joints.
    JointStates,
    /// Publishes what an IMU measures.
    ImuBroadcaster,
    /// Publishes where the robot is.
    Odometry,
}

impl PartKind {
    /// Its name for scripts.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Lidar => "lidar",
            Self::Camera => "camera",
            Self::Imu => "imu",
            Self::DiffDrive => "diff_drive",
            Self::Trajectory => "trajectory",
            Self::Forward => "forward",
            Self::JointStates => "joint_states",
            Self::ImuBroadcaster => "imu_broadcaster",
            Self::Odometry => "odometry",
        }
    }

    /// Whether it measures with an object of its own.
    pub fn is_sensor(self) -> bool {
        matches!(self, Self::Lidar | Self::Camera | Self::Imu)
    }
}

/// What a parameter is.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number, finite.
    Number(f64),
    /// A text.
    Text(String),
    /// Yes or no.
    Flag(bool),
    /// Texts.
    Texts(Vec<String>),
    /// Numbers, finite.
    Numbers(Vec<f64>),
}

impl Part {
    /// The text of a parameter, if it is one.
    pub fn text(&self, key: &str) -> Option<&str> {
        match self.values.get(key) {
            Some(Value::Text(text)) => Some(text),
            _ => None,
        }
    }

    /// The number of a parameter, if it is one.
    pub fn number(&self, key: &str) -> Option<f64> {
        match self.values.get(key) {
            Some(Value::Number(number)) => Some(*number),
            _ => None,
        }
    }

    /// The texts of a parameter.
    pub fn texts(&self, key: &str) -> &[String] {
        match self.values.get(key) {
            Some(Value::Texts(texts)) => texts,
            _ => &[],
        }
    }

    fn set_text(&mut self, key: &str, text: String) {
        self.values.insert(key.to_owned(), Value::Text(text));
    }

    fn set_default_text(&mut self, key: &str, text: impl FnOnce() -> String) {
        if self.text(key).is_none() {
            self.set_text(key, text());
        }
    }
}

impl Interface {
    /// Adds what another file says.
    pub fn extend(&mut self, other: Self) {
        self.namespace = other.namespace.or(self.namespace.take());
        self.model = other.model.or(self.model.take());
        self.parts.extend(other.parts);
        self.commands.extend(other.commands);
        self.parameter_files.extend(other.parameter_files);
    }

    /// Leaves out what names joints or links that the robot does not have, and says so.
    #[must_use]
    pub fn fitting(mut self, robot: &Robot) -> Parsed<Self> {
        let mut notes = Notes::default();
        self.parts.retain(|part| fits(part, robot, &mut notes));
        self.commands.retain(|command| {
            let is_there = robot.joint(&command.joint).is_some();
            if !is_there {
                let message = format!("there is no joint '{}'", short(&command.joint));
                notes.add(command.line, "joint", message);
            }
            is_there
        });
        notes.finish(self)
    }
}

/// Whether all joints and links that a part names are there.
fn fits(part: &Part, robot: &Robot, notes: &mut Notes) -> bool {
    let joints = ["joints", "left_wheel_names", "right_wheel_names"]
        .iter()
        .flat_map(|key| part.texts(key));
    let missing_joint = joints
        .filter(|joint| robot.joint(joint).is_none())
        .map(|joint| format!("there is no joint '{}'", short(joint)))
        .next();
    let missing_link = part
        .text("link")
        .filter(|link| part.kind.is_sensor() && robot.link(link).is_none())
        .map(|link| format!("there is no link '{}'", short(link)));
    let Some(problem) = missing_joint.or(missing_link) else {
        return true;
    };
    let name = short(&part.name);
    notes.add(
        part.line,
        part.kind.as_str(),
        format!("'{name}': {problem}; it is left out"),
    );
    false
}
