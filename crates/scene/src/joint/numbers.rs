//! Types, modes and ways of control of joints by the numbers that scripts and files have for them.

use super::{Control, JointMode, JointType};

impl JointType {
    /// The type with that number, in scripts and in files.
    pub fn from_code(code: i64) -> Option<Self> {
        [Self::Revolute, Self::Prismatic, Self::Spherical]
            .into_iter()
            .find(|t| *t as i64 == code)
    }

    /// Alias of a new joint.
    pub fn alias(self) -> &'static str {
        match self {
            Self::Revolute => "Revolute_joint",
            Self::Prismatic => "Prismatic_joint",
            Self::Spherical => "Spherical_joint",
        }
    }
}

impl JointMode {
    /// The mode with a script's number. Joints that depended on inverse kinematics are kinematic now.
    pub fn from_code(code: i64) -> Option<Self> {
        match code {
            0 | 3 => Some(Self::Kinematic),
            2 => Some(Self::InverseKinematics),
            4 => Some(Self::Dependent),
            5 => Some(Self::Dynamic),
            _ => None,
        }
    }

    /// The mode with a file's number. Files know one mode more, and joints that depend on others by two numbers.
    pub fn of_file(number: i32) -> Self {
        match number {
            1 => Self::Motion,
            2 => Self::InverseKinematics,
            3 | 4 => Self::Dependent,
            5 => Self::Dynamic,
            _ => Self::Kinematic,
        }
    }
}

impl Control {
    const ALL: [Self; 8] = [
        Self::Free,
        Self::Force,
        Self::Velocity,
        Self::Position,
        Self::PositionOrCallback,
        Self::Spring,
        Self::SpringOrCallback,
        Self::Callback,
    ];

    /// The way of control with a script's number, if there is one: scripts choose none of those that only old scenes have.
    pub fn from_code(code: i64) -> Option<Self> {
        Self::with_number(code).filter(|control| !control.is_of_old_scenes())
    }

    /// The way of control with a file's number.
    pub fn of_file(number: i32) -> Self {
        Self::with_number(number.into()).unwrap_or(Self::Free)
    }

    fn with_number(number: i64) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|control| *control as i64 == number)
    }

    fn is_of_old_scenes(self) -> bool {
        matches!(self, Self::PositionOrCallback | Self::SpringOrCallback)
    }

    /// Whether a script is called in each sub-step to decide what the joint does.
    pub fn calls_script(self) -> bool {
        matches!(
            self,
            Self::Callback | Self::PositionOrCallback | Self::SpringOrCallback
        )
    }
}

#[cfg(test)]
mod tests {
    use super::{Control, JointMode};

    #[test]
    fn files_know_what_scripts_cannot_choose() {
        assert_eq!(JointMode::from_code(1), None);
        assert_eq!(JointMode::of_file(1), JointMode::Motion);
        assert_eq!(JointMode::from_code(3), Some(JointMode::Kinematic));
        assert_eq!(JointMode::of_file(3), JointMode::Dependent);
        assert_eq!(Control::from_code(9), None);
        assert_eq!(Control::of_file(9), Control::PositionOrCallback);
        assert_eq!(Control::of_file(7), Control::Free);
    }
}
