//! Controllers where none are said: those that robots usually have, under their usual names.

use super::finish::finish;
use super::notes::Notes;
use super::{Interface, Part, PartKind, Value};

/// What joints are told, the kind of the controller, and its name.
const USUAL: [(&str, PartKind, &str); 4] = [
    (
        "position",
        PartKind::Trajectory,
        "joint_trajectory_controller",
    ),
    ("position", PartKind::Forward, "forward_position_controller"),
    ("velocity", PartKind::Forward, "forward_velocity_controller"),
    ("effort", PartKind::Forward, "forward_effort_controller"),
];

impl Interface {
    /// Adds controllers for the joints that may be told something, and that no part moves.
    pub fn add_usual_controllers(&mut self) {
        let claimed: Vec<String> = ["joints", "left_wheel_names", "right_wheel_names"]
            .iter()
            .flat_map(|key| {
                self.parts
                    .iter()
                    .filter(|part| part.kind.moves())
                    .flat_map(|part| part.texts(key))
            })
            .cloned()
            .collect();
        for (interface, kind, name) in USUAL {
            let free = self
                .commands
                .iter()
                .filter(|command| command.interface == interface);
            let joints: Vec<String> = free
                .map(|command| command.joint.clone())
                .filter(|joint| !claimed.contains(joint))
                .collect();
            if joints.is_empty() {
                continue;
            }
            let mut part = Part {
                kind,
                name: name.to_owned(),
                values: [("joints".to_owned(), Value::Texts(joints))].into(),
                line: 0,
            };
            part.set_text("interface_name", interface.to_owned());
            self.parts.extend(finish(part, &mut Notes::default()));
        }
    }
}

impl PartKind {
    /// Whether it moves joints.
    pub fn moves(self) -> bool {
        matches!(self, Self::DiffDrive | Self::Trajectory | Self::Forward)
    }
}
