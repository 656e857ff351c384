//! A model as it was read becomes a robot: its parts are placed, its joints join them.

use std::collections::BTreeMap;

use bounded_xml::Node;

use super::Model;
use super::frames::{Frames, MODEL, WORLD};
use super::joint::{AxisText, JointText};
use crate::model::{Joint, JointKind, Link, Mimic, Pose, Robot, Sensor};
use crate::xml::{Source, short};

/// A model as it is read, with those inside of it.
#[derive(Default)]
pub struct Draft {
    pub name: String,
    pub is_static: bool,
    /// With their full names.
    pub links: Vec<(String, Link)>,
    /// With the scopes that their names are in.
    pub joints: Vec<(String, JointText)>,
    pub sensors: Vec<Sensor>,
}

impl Draft {
    /// The model with all poses, relative to it.
    pub fn placed(self, frames: &Frames, source: &mut Source, node: Node) -> Model {
        let scope = format!("{}::", self.name);
        let pose = frames
            .in_world(&format!("{scope}{MODEL}"))
            .unwrap_or_else(Pose::identity);
        let mut robot = Robot {
            name: self.name,
            sensors: self.sensors,
            ..Robot::default()
        };
        let mut index = BTreeMap::new();
        for (full, mut link) in self.links {
            link.pose = match frames.in_world(&full) {
                Some(placed) => pose.inverse() * placed,
                None => {
                    source.warn(
                        node,
                        format!("the pose of '{}' is defined in itself", short(&full)),
                    );
                    Pose::identity()
                }
            };
            link.name = full.strip_prefix(&scope).unwrap_or(&full).to_owned();
            index.entry(full).or_insert(robot.links.len());
            robot.links.push(link);
        }
        let mut assembly = Assembly {
            frames,
            robot,
            index,
            model: pose,
            mimics: Vec::new(),
            first_axes: BTreeMap::new(),
        };
        for (joint_scope, joint) in self.joints {
            if let Err(reason) = assembly.add_joint(&scope, &joint_scope, &joint) {
                source.warn(
                    node,
                    format!(
                        "joint '{}' (line {}): {reason}; it is left out",
                        short(&joint.name),
                        joint.line
                    ),
                );
            }
        }
        Model {
            robot: assembly.finish(source, node),
            pose,
            is_static: self.is_static,
        }
    }
}

/// A robot whose joints are being added.
struct Assembly<'a> {
    frames: &'a Frames,
    robot: Robot,
    /// Links by their full names.
    index: BTreeMap<String, usize>,
    /// The model in the world.
    model: Pose,
    /// Joints, the full names of those that they mimic, multiplier and offset.
    mimics: Vec<(usize, String, f64, f64)>,
    /// Joints by their full names.
    first_axes: BTreeMap<String, usize>,
}

impl Assembly<'_> {
    fn add_joint(&mut self, model: &str, scope: &str, text: &JointText) -> Result<(), String> {
        let parent = self.end(scope, &text.parent)?;
        let child = self.end(scope, &text.child)?;
        let full = format!("{scope}{}", text.name);
        let frame = self
            .frames
            .in_world(&full)
            .ok_or("its pose is defined in itself")?;
        let in_model = self.model.inverse() * frame;
        let origin = self.robot.links[parent].pose.inverse() * in_model;
        let child_pose = in_model.inverse() * self.robot.links[child].pose;
        let name = full.strip_prefix(model).unwrap_or(&full).to_owned();
        self.first_axes
            .entry(full)
            .or_insert(self.robot.joints.len());
        let axes = text
            .axes
            .iter()
            .map(Some)
            .chain(std::iter::once(None))
            .take(text.axes.len().max(1))
            .collect::<Vec<_>>();
        let [first, rest @ ..] = axes.as_slice() else {
            return Ok(());
        };
        if rest.is_empty() {
            return self.push(
                scope,
                name,
                text,
                *first,
                ([parent, child], [origin, child_pose], frame),
            );
        }
        // Two axes: a link without mass is between them.
        let cross = Link {
            name: format!("{name}_cross"),
            pose: in_model,
            ..Link::default()
        };
        self.robot.links.push(cross);
        let between = self.robot.links.len() - 1;
        self.push(
            scope,
            name.clone(),
            text,
            *first,
            ([parent, between], [origin, Pose::identity()], frame),
        )?;
        let second = format!("{name}_2");
        self.push(
            scope,
            second,
            text,
            rest[0],
            ([between, child], [Pose::identity(), child_pose], frame),
        )
    }

    /// Adds a joint with one axis. `at` has its ends, its frame in the parent's with the child's in its own, and its frame in the world.
    fn push(
        &mut self,
        scope: &str,
        name: String,
        text: &JointText,
        axis: Option<&AxisText>,
        at: ([usize; 2], [Pose; 2], Pose),
    ) -> Result<(), String> {
        let ([parent, child], [origin, child_pose], frame) = at;
        let mut joint = Joint {
            name,
            kind: text.kind,
            parent,
            child,
            origin,
            child_pose,
            axis: [0.0, 0.0, 1.0],
            limits: Default::default(),
            dynamics: Default::default(),
            mimic: None,
            reference: 0.0,
            line: text.line,
        };
        if let Some(axis) = axis {
            joint.axis = self.axis(scope, axis, &frame)?;
            (joint.limits, joint.dynamics) = (axis.limits, axis.dynamics);
            let is_endless = axis.limits.lower.is_none() && axis.limits.upper.is_none();
            if joint.kind == JointKind::Revolute && is_endless {
                joint.kind = JointKind::Continuous;
            }
            let mimic = axis.mimic.iter().map(|(master, multiplier, offset)| {
                (format!("{scope}{master}"), *multiplier, *offset)
            });
            let index = self.robot.joints.len();
            self.mimics.extend(
                mimic.map(|(master, multiplier, offset)| (index, master, multiplier, offset)),
            );
        }
        self.robot.joints.push(joint);
        Ok(())
    }

    fn axis(&self, scope: &str, axis: &AxisText, joint: &Pose) -> Result<[f64; 3], String> {
        if axis.expressed_in.is_empty() {
            return Ok(axis.xyz);
        }
        let unknown = || {
            format!(
                "there is no frame '{}' for its axis",
                short(&axis.expressed_in)
            )
        };
        let full = self
            .frames
            .full_name(scope, &axis.expressed_in)
            .ok_or_else(unknown)?;
        let frame = self.frames.in_world(&full).ok_or_else(unknown)?;
        Ok((joint.rotation.inverse() * frame.rotation * nalgebra::Vector3::from(axis.xyz)).into())
    }

    /// The link at an end of a joint; the world is one, if a joint names it.
    fn end(&mut self, scope: &str, name: &str) -> Result<usize, String> {
        let missing = || format!("there is no link '{}'", short(name));
        let full = self.frames.full_name(scope, name).ok_or_else(missing)?;
        let link = self.frames.link_of(&full).ok_or_else(missing)?;
        if link == WORLD && !self.index.contains_key(WORLD) {
            self.index.insert(WORLD.to_owned(), self.robot.links.len());
            self.robot.links.push(Link {
                name: WORLD.to_owned(),
                pose: self.model.inverse(),
                ..Link::default()
            });
        }
        self.index.get(&link).copied().ok_or_else(missing)
    }

    fn finish(mut self, source: &mut Source, node: Node) -> Robot {
        for (index, master, multiplier, offset) in &self.mimics {
            if let Some(joint) = self
                .first_axes
                .get(master)
                .copied()
                .filter(|joint| joint != index)
            {
                self.robot.joints[*index].mimic = Some(Mimic {
                    joint,
                    multiplier: *multiplier,
                    offset: *offset,
                });
            }
        }
        for (index, ..) in self.mimics {
            if let Err(reason) = self.robot.whole_mimic(index) {
                let joint = &mut self.robot.joints[index];
                joint.mimic = None;
                source.warn(
                    node,
                    format!(
                        "joint '{}' (line {}) {reason}; it moves by itself",
                        short(&joint.name),
                        joint.line
                    ),
                );
            }
        }
        self.robot
    }
}
