//! Bodies become links, their joints the joints above them.

use std::collections::BTreeMap;

use nalgebra::{Translation3, Vector3};

use super::attributes::{Attributes, MAIN};
use super::document::Document;
use super::element::{Element, Report};
use super::flex::Reader;
use super::inertia::Weighed;
use super::touching::{BodyPlace, Pairs, TouchingGeom};
use super::{Files, Model, Site};
use crate::model::{Dynamics, Inertial, Joint, JointKind, Limits, Link, Pose};
use crate::xml::short;

/// What bodies are made with.
pub struct Builder<'a> {
    pub document: &'a Document,
    pub files: &'a mut dyn Files,
    pub report: Report,
    pub model: Model,
    pub pairs: Pairs<'a>,
    pub touching: Vec<TouchingGeom>,
    /// Of the links that are bodies.
    pub places: BTreeMap<usize, BodyPlace>,
}

/// Where elements of a body are: on a link, in a frame of it, with a class of defaults.
#[derive(Debug, Clone)]
pub struct Place<'a> {
    pub link: usize,
    pub pose: Pose,
    class: &'a str,
}

/// What a body says beside its parts.
#[derive(Default)]
struct Contents {
    inertial: Option<Inertial>,
    geoms: Vec<Weighed>,
}

/// A joint of a body, in the body's frame where all joints are at their references.
struct BodyJoint {
    joint: Joint,
    anchor: Vector3<f64>,
}

impl<'a> Builder<'a> {
    pub fn new(
        document: &'a Document,
        root: &'a Element,
        files: &'a mut dyn Files,
        mut report: Report,
    ) -> Self {
        let mut model = Model {
            fixed: vec![0],
            ..Model::default()
        };
        model.robot.links.push(Link {
            name: "world".to_owned(),
            ..Link::default()
        });
        Self {
            document,
            files,
            pairs: Pairs::new(root, &mut report),
            report,
            model,
            touching: Vec::new(),
            places: BTreeMap::new(),
        }
    }

    pub fn into_parts(self) -> (Model, Report) {
        (self.model, self.report)
    }

    /// Adds what is in a `<worldbody>`.
    pub fn add_world(&mut self, element: &'a Element) {
        let place = Place {
            link: 0,
            pose: Pose::identity(),
            class: element.attribute("childclass").unwrap_or(MAIN),
        };
        self.add_contents(element, &place, &mut Contents::default());
    }

    fn attributes(&mut self, element: &'a Element, class: &str) -> Attributes<'a> {
        self.document.defaults.of(element, class, &mut self.report)
    }

    fn add_contents(&mut self, element: &'a Element, place: &Place<'a>, contents: &mut Contents) {
        for child in &element.children {
            match child.name.as_str() {
                "body" => self.add_body(child, place),
                "geom" => {
                    let attributes = self.attributes(child, place.class);
                    contents.geoms.extend(self.add_geom(&attributes, place));
                }
                "site" => {
                    let attributes = self.attributes(child, place.class);
                    self.add_site(&attributes, place);
                }
                "frame" => {
                    let place = self.inside(child, place);
                    self.add_contents(child, &place, contents);
                }
                "inertial" => {
                    let attributes = self.attributes(child, place.class);
                    contents.inertial = Some(self.read_inertial(&attributes, place.pose));
                }
                "joint" | "freejoint" => {}
                "flexcomp" | "composite" => self.add_flex(child, place),
                other => {
                    let text = format!(
                        "<{}> is not read inside of <{}>",
                        short(other),
                        short(&element.name)
                    );
                    self.report.leave_out(child, text);
                }
            }
        }
    }

    /// The place inside of a frame.
    fn inside(&mut self, frame: &'a Element, place: &Place<'a>) -> Place<'a> {
        let attributes = self.attributes(frame, place.class);
        let pose = place.pose * self.document.pose(&attributes, &mut self.report);
        Place {
            link: place.link,
            pose,
            class: frame.attribute("childclass").unwrap_or(place.class),
        }
    }

    fn add_flex(&mut self, element: &'a Element, place: &Place) {
        let link_name = self.model.robot.links[place.link].name.clone();
        let mut reader = Reader {
            document: self.document,
            report: &mut self.report,
            files: &mut *self.files,
            link_name: &link_name,
        };
        match reader.read(element) {
            Ok(flex) => self.model.flexes.push(flex.on(place.link, place.pose)),
            Err(reason) => self.report.leave_out(element, reason),
        }
    }

    fn add_site(&mut self, attributes: &Attributes, place: &Place) {
        let pose = place.pose * self.document.pose(attributes, &mut self.report);
        let name = attributes
            .get("name")
            .map_or_else(|| format!("site_{}", self.model.sites.len()), str::to_owned);
        self.model.sites.push(Site {
            name,
            link: place.link,
            pose,
        });
    }

    fn add_body(&mut self, element: &'a Element, outer: &Place<'a>) {
        let attributes = self.attributes(element, outer.class);
        let pose = outer.pose * self.document.pose(&attributes, &mut self.report);
        let class = element.attribute("childclass").unwrap_or(outer.class);
        let number = self.model.robot.links.len();
        let name = element
            .attribute("name")
            .map_or_else(|| format!("body_{number}"), str::to_owned);
        let mut joints = Vec::new();
        let mut is_free = false;
        let inner = Place {
            link: 0,
            pose: Pose::identity(),
            class,
        };
        self.collect_joints(element, &inner, &name, &mut joints, &mut is_free);
        let mut link = Link {
            name,
            line: element.line,
            ..Link::default()
        };
        if is_free {
            link.pose = pose;
        }
        let moves = is_free || !joints.is_empty();
        let index = if is_free {
            self.add_link(link)
        } else {
            self.add_moved(element, link, outer.link, pose, joints)
        };
        self.note_place(index, outer.link, moves);
        self.note_compensation(&attributes, index);
        let place = Place {
            link: index,
            ..inner
        };
        let mut contents = Contents::default();
        self.add_contents(element, &place, &mut contents);
        let inertial = self.inertial(element, contents.inertial, &contents.geoms);
        self.model.robot.links[index].inertial = inertial.filter(|inertial| inertial.mass > 0.0);
    }

    fn note_place(&mut self, link: usize, parent: usize, moves: bool) {
        let above = self.places.get(&parent).copied().unwrap_or_default();
        let place = BodyPlace {
            rigid: link,
            parent: above.rigid,
        };
        self.places.insert(link, if moves { place } else { above });
    }

    fn add_link(&mut self, link: Link) -> usize {
        self.model.robot.links.push(link);
        self.model.robot.links.len() - 1
    }

    /// Adds a link that joints move; of one without joints, the joint that fixes it. `pose` is that of the body in the parent.
    fn add_moved(
        &mut self,
        element: &Element,
        link: Link,
        parent: usize,
        pose: Pose,
        mut joints: Vec<BodyJoint>,
    ) -> usize {
        let line = element.line;
        let Some(last) = joints.pop() else {
            let joint = fixed(format!("{}_fixed", link.name), line);
            let is_mocap = element.attribute("mocap") == Some("true");
            let index = self.add_link(link);
            if is_mocap || self.model.fixed.binary_search(&parent).is_ok() {
                self.model.fixed.push(index);
            }
            self.model.robot.joints.push(Joint {
                parent,
                child: index,
                origin: pose,
                ..joint
            });
            return index;
        };
        let (mut carrier, mut frame) = (parent, pose);
        for (number, joint) in joints.into_iter().enumerate() {
            let between = self.add_link(Link {
                name: format!("{}_{}", link.name, number + 1),
                ..Link::default()
            });
            self.add_joint(joint, [carrier, between], frame);
            (carrier, frame) = (between, Pose::identity());
        }
        let index = self.add_link(link);
        self.add_joint(last, [carrier, index], frame);
        index
    }

    /// `frame`: that of the body in the parent, with this joint at its reference.
    fn add_joint(&mut self, body_joint: BodyJoint, [parent, child]: [usize; 2], frame: Pose) {
        let BodyJoint { mut joint, anchor } = body_joint;
        (joint.parent, joint.child) = (parent, child);
        joint.origin = frame * Pose::from(Translation3::from(anchor));
        joint.child_pose = Translation3::from(-anchor).into();
        if joint.kind.numbers() == 1 && joint.reference != 0.0 {
            joint.origin *= joint.motion(&[-joint.reference]);
        }
        self.model.robot.joints.push(joint);
    }

    /// The joints of a body, those inside of frames as well.
    fn collect_joints(
        &mut self,
        element: &'a Element,
        place: &Place<'a>,
        body: &str,
        joints: &mut Vec<BodyJoint>,
        is_free: &mut bool,
    ) {
        for child in &element.children {
            match child.name.as_str() {
                "freejoint" => *is_free = true,
                "joint" => {
                    let attributes = self.attributes(child, place.class);
                    if attributes.get("type") == Some("free") {
                        *is_free = true;
                        continue;
                    }
                    let name = child.attribute("name").map(str::to_owned);
                    let name = name.unwrap_or_else(|| format!("{body}_joint_{}", joints.len() + 1));
                    joints.push(self.read_joint(&attributes, place, name));
                }
                "frame" => {
                    let place = self.inside(child, place);
                    self.collect_joints(child, &place, body, joints, is_free);
                }
                _ => {}
            }
        }
    }

    fn read_joint(&mut self, attributes: &Attributes, place: &Place, name: String) -> BodyJoint {
        let anchor = attributes.numbers(&mut self.report, "pos", [0.0; 3]);
        let axis = attributes.numbers(&mut self.report, "axis", [0.0, 0.0, 1.0]);
        let kind = match attributes.get("type").unwrap_or("hinge") {
            "slide" => JointKind::Prismatic,
            "ball" => JointKind::Spherical,
            "hinge" => JointKind::Revolute,
            other => {
                self.report.warn(
                    attributes.element,
                    format!(
                        "the type '{}' is not known: it is taken for a hinge",
                        short(other)
                    ),
                );
                JointKind::Revolute
            }
        };
        let mut joint = fixed(name, attributes.element.line);
        joint.kind = kind;
        joint.axis = (place.pose.rotation * Vector3::from(axis)).into();
        if joint.axis.iter().all(|number| number.abs() < 1e-9) {
            self.report
                .warn(attributes.element, "an axis without length: z is taken");
            joint.axis = [0.0, 0.0, 1.0];
        }
        self.set_motion(attributes, &mut joint);
        BodyJoint {
            joint,
            anchor: place.pose.transform_point(&anchor.into()).coords,
        }
    }

    /// Limits, reference, spring and damper of a joint.
    fn set_motion(&mut self, attributes: &Attributes, joint: &mut Joint) {
        let settings = &self.document.settings;
        let turns = joint.kind == JointKind::Revolute;
        let unit = |number: f64| {
            if turns {
                settings.angle(number)
            } else {
                number
            }
        };
        let mut number = |name: &str| attributes.number(&mut self.report, name);
        joint.reference = unit(number("ref").unwrap_or(0.0));
        joint.dynamics = Dynamics {
            damping: number("damping").unwrap_or(0.0),
            friction: number("frictionloss").unwrap_or(0.0),
            stiffness: number("stiffness").unwrap_or(0.0),
            rest: unit(number("springref").unwrap_or(0.0)),
            armature: number("armature").unwrap_or(0.0),
        };
        let is_limited = |name: &str, range: &str| {
            attributes
                .is_true(name)
                .unwrap_or(settings.limits_by_range && attributes.get(range).is_some())
        };
        if joint.kind.numbers() == 1 && is_limited("limited", "range") {
            let [low, high] = attributes
                .numbers(&mut self.report, "range", [0.0; 2])
                .map(unit);
            joint.limits = Limits {
                lower: Some(low.min(high)),
                upper: Some(high.max(low)),
                ..joint.limits
            };
        } else if turns {
            joint.kind = JointKind::Continuous;
        }
        if is_limited("actuatorfrclimited", "actuatorfrcrange") {
            let range = attributes.numbers(&mut self.report, "actuatorfrcrange", [0.0; 2]);
            joint.limits.effort = Some(range[0].abs().max(range[1].abs()));
        }
    }
}

/// A joint that says nothing yet.
fn fixed(name: String, line: u32) -> Joint {
    Joint {
        name,
        kind: JointKind::Fixed,
        parent: 0,
        child: 0,
        origin: Pose::identity(),
        child_pose: Pose::identity(),
        axis: [0.0, 0.0, 1.0],
        limits: Limits::default(),
        dynamics: Dynamics::default(),
        mimic: None,
        reference: 0.0,
        line,
    }
}
