//! The parameters of each kind of part, and what they have to be.

use super::tree::{Node, Tree};
use super::{PartKind, Value};

/// What a parameter has to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Form {
    /// Between two numbers.
    Number(f64, f64),
    /// A whole number between two numbers.
    Count(u32, u32),
    Text,
    Flag,
    Texts,
    Numbers(usize),
    /// Known, and without a meaning in a simulation.
    Ignored,
}

use Form::{Count, Flag, Ignored, Number, Numbers, Text, Texts};

/// Lengths and rates that are no errors.
const LENGTH: Form = Number(1e-6, 1e6);
const RATE: Form = Number(0.0, 1e6);
const ANGLE: Form = Number(-6.3, 6.3);
const ANY: Form = Number(-1e9, 1e9);
/// Columns, rows and rays.
const SIDE: Form = Count(1, 4096);

type Keys = &'static [(&'static str, Form)];

const COMMON: Keys = &[
    ("namespace", Text),
    ("type", Ignored),
    ("use_sim_time", Ignored),
    ("update_rate", Ignored),
    ("is_async", Ignored),
];
const SENSOR: Keys = &[
    ("frame", Text),
    ("link", Text),
    ("object", Text),
    ("pose", Numbers(6)),
    ("rate", RATE),
    ("topic", Text),
];
const LIDAR: Keys = &[
    ("max_angle", ANGLE),
    ("max_range", LENGTH),
    ("max_vertical_angle", ANGLE),
    ("min_angle", ANGLE),
    ("min_range", Number(0.0, 1e6)),
    ("min_vertical_angle", ANGLE),
    ("noise", Number(0.0, 1e3)),
    ("output", Text),
    ("points_topic", Text),
    ("samples", Count(1, 65_536)),
    ("vertical_samples", SIDE),
];
const CAMERA: Keys = &[
    ("camera_name", Text),
    ("color", Flag),
    ("depth", Flag),
    ("depth_info_topic", Text),
    ("depth_topic", Text),
    ("far", LENGTH),
    ("format", Text),
    ("fov", Number(1e-3, 3.1)),
    ("height", SIDE),
    ("info_topic", Text),
    ("near", LENGTH),
    ("points", Flag),
    ("points_topic", Text),
    ("width", SIDE),
];
const IMU: Keys = &[
    ("acceleration_noise", Number(0.0, 1e3)),
    ("rotation_noise", Number(0.0, 1e3)),
];
const DIFF_DRIVE: Keys = &[
    ("angular.z.has_acceleration_limits", Flag),
    ("angular.z.has_velocity_limits", Flag),
    ("angular.z.max_acceleration", ANY),
    ("angular.z.max_velocity", ANY),
    ("angular.z.min_acceleration", ANY),
    ("angular.z.min_velocity", ANY),
    ("angular.z.has_jerk_limits", Ignored),
    ("base_frame_id", Text),
    ("cmd_vel_timeout", Number(0.0, 1e6)),
    ("enable_odom_tf", Flag),
    ("ground_truth", Flag),
    ("left_wheel_names", Texts),
    ("left_wheel_radius_multiplier", LENGTH),
    ("linear.x.has_acceleration_limits", Flag),
    ("linear.x.has_velocity_limits", Flag),
    ("linear.x.max_acceleration", ANY),
    ("linear.x.max_velocity", ANY),
    ("linear.x.min_acceleration", ANY),
    ("linear.x.min_velocity", ANY),
    ("linear.x.has_jerk_limits", Ignored),
    ("odom_frame_id", Text),
    ("odom_topic", Text),
    ("open_loop", Flag),
    ("pose_covariance_diagonal", Numbers(6)),
    ("position_feedback", Ignored),
    ("publish_limited_velocity", Ignored),
    ("publish_rate", RATE),
    ("right_wheel_names", Texts),
    ("right_wheel_radius_multiplier", LENGTH),
    ("topic", Text),
    ("twist_covariance_diagonal", Numbers(6)),
    ("use_stamped_vel", Ignored),
    ("velocity_rolling_window_size", Ignored),
    ("wheel_radius", LENGTH),
    ("wheel_separation", LENGTH),
    ("wheel_separation_multiplier", LENGTH),
    ("wheels_per_side", Ignored),
];
const TRAJECTORY: Keys = &[
    ("action_monitor_rate", Ignored),
    ("allow_integration_in_goal_trajectories", Ignored),
    ("allow_nonzero_velocity_at_trajectory_end", Ignored),
    ("allow_partial_joints_goal", Ignored),
    ("command_interfaces", Texts),
    ("constraints.goal_time", Number(0.0, 1e6)),
    ("constraints.stopped_velocity_tolerance", Ignored),
    ("joints", Texts),
    ("open_loop_control", Ignored),
    ("state_interfaces", Ignored),
    ("state_publish_rate", Ignored),
];
const FORWARD: Keys = &[("interface_name", Text), ("joints", Texts), ("topic", Text)];
const JOINT_STATES: Keys = &[
    ("extra_joints", Ignored),
    ("interfaces", Ignored),
    ("joints", Texts),
    ("rate", RATE),
    ("topic", Text),
    ("use_local_topics", Flag),
    ("use_urdf_to_filter", Ignored),
];
const IMU_BROADCASTER: Keys = &[
    ("frame_id", Text),
    ("sensor_name", Text),
    ("topic", Text),
    ("static_covariance_angular_velocity", Ignored),
    ("static_covariance_linear_acceleration", Ignored),
    ("static_covariance_orientation", Ignored),
];
const ODOMETRY: Keys = &[
    ("base_frame_id", Text),
    ("enable_odom_tf", Flag),
    ("odom_frame_id", Text),
    ("odom_topic", Text),
    ("publish_rate", RATE),
];

impl PartKind {
    fn keys(self) -> [Keys; 3] {
        match self {
            Self::Lidar => [COMMON, SENSOR, LIDAR],
            Self::Camera => [COMMON, SENSOR, CAMERA],
            Self::Imu => [COMMON, SENSOR, IMU],
            Self::DiffDrive => [COMMON, DIFF_DRIVE, &[]],
            Self::Trajectory => [COMMON, TRAJECTORY, &[]],
            Self::Forward => [COMMON, FORWARD, &[]],
            Self::JointStates => [COMMON, JOINT_STATES, &[]],
            Self::ImuBroadcaster => [COMMON, IMU_BROADCASTER, &[]],
            Self::Odometry => [COMMON, ODOMETRY, &[]],
        }
    }

    /// What a parameter has to be; None for one that is not known.
    pub(super) fn form(self, key: &str) -> Option<Form> {
        let is_tolerance = key.ends_with(".goal") || key.ends_with(".trajectory");
        if self == Self::Trajectory && key.starts_with("constraints.") && is_tolerance {
            return Some(Number(0.0, 1e6));
        }
        let mut all = self.keys().into_iter().flatten();
        all.find(|(name, _)| *name == key).map(|(_, form)| *form)
    }
}

impl Form {
    /// Reads a value; an error says what is needed.
    pub fn read(self, tree: &Tree) -> Result<Option<Value>, String> {
        match (self, &tree.node) {
            (Ignored, _) => Ok(None),
            (Number(..) | Count(..), Node::Number(number)) => self.of_number(*number).map(Some),
            (Flag, Node::Flag(flag)) => Ok(Some(Value::Flag(*flag))),
            (Text, Node::Text(text)) => Ok(Some(Value::Text(text.clone()))),
            (Texts, Node::Text(text)) => Ok(Some(Value::Texts(vec![text.clone()]))),
            (Texts, Node::List(items)) => {
                let texts = items.iter().map(|item| item.text().map(str::to_owned));
                let texts: Option<Vec<String>> = texts.collect();
                texts
                    .map(|texts| Some(Value::Texts(texts)))
                    .ok_or_else(|| self.needed())
            }
            (Numbers(_), Node::List(items)) => {
                let numbers: Option<Vec<f64>> = items.iter().map(Tree::number).collect();
                self.of_numbers(numbers.unwrap_or_default()).map(Some)
            }
            _ => Err(self.needed()),
        }
    }

    /// Reads the text of an element.
    pub fn read_text(self, text: &str) -> Result<Option<Value>, String> {
        let text = text.trim();
        let words = || text.split_whitespace();
        match self {
            Ignored => Ok(None),
            Number(..) | Count(..) => match text.parse() {
                Ok(number) => self.of_number(number).map(Some),
                Err(_) => Err(self.needed()),
            },
            Flag => match text.to_ascii_lowercase().as_str() {
                "true" | "1" => Ok(Some(Value::Flag(true))),
                "false" | "0" => Ok(Some(Value::Flag(false))),
                _ => Err(self.needed()),
            },
            Text if text.is_empty() => Err(self.needed()),
            Text => Ok(Some(Value::Text(text.to_owned()))),
            Texts => Ok(Some(Value::Texts(words().map(str::to_owned).collect()))),
            Numbers(_) => {
                let numbers: Vec<f64> = words()
                    .map_while(|word| word.parse().ok())
                    .take(64)
                    .collect();
                self.of_numbers(numbers).map(Some)
            }
        }
    }

    fn of_number(self, number: f64) -> Result<Value, String> {
        let (low, high) = match self {
            Number(low, high) => (low, high),
            Count(low, high) => (low.into(), high.into()),
            _ => return Err(self.needed()),
        };
        let is_whole = number.fract() == 0.0 || matches!(self, Number(..));
        if (low..=high).contains(&number) && is_whole {
            Ok(Value::Number(number))
        } else {
            Err(self.needed())
        }
    }

    fn of_numbers(self, numbers: Vec<f64>) -> Result<Value, String> {
        let is_usual = |number: &f64| number.abs() <= 1e9;
        if self == Numbers(numbers.len()) && numbers.iter().all(is_usual) {
            Ok(Value::Numbers(numbers))
        } else {
            Err(self.needed())
        }
    }

    fn needed(self) -> String {
        match self {
            Number(low, high) => format!("a number from {low} to {high} is needed"),
            Count(low, high) => format!("a whole number from {low} to {high} is needed"),
            Text => "a text is needed".to_owned(),
            Flag => "true or false is needed".to_owned(),
            Texts => "texts are needed".to_owned(),
            Numbers(count) => format!("{count} numbers are needed"),
            Ignored => String::new(),
        }
    }
}
