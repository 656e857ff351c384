//! Robots as URDF.

use std::fmt::Write;

use crate::model::{Geometry, Inertial, Joint, JointKind, Link, Material, Pose, Robot};
use crate::positions::to_rpy;

/// The text of a URDF file. Numbers are written so that the same ones are read again; frames of links become those of their joints, as URDF has it.
pub fn write(robot: &Robot) -> String {
    let robot = robot.with_frames_at_joints();
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n",
        escaped(&robot.name)
    );
    for material in &robot.materials {
        write_material(&mut text, material, "  ");
    }
    for link in &robot.links {
        write_link(&mut text, link);
    }
    for joint in &robot.joints {
        write_joint(&mut text, &robot, joint);
    }
    text.push_str("</robot>\n");
    text
}

impl Robot {
    /// The same robot with the frame of each link at the joint that moves it.
    #[must_use]
    pub fn with_frames_at_joints(&self) -> Self {
        let mut robot = self.clone();
        let parents = self.parent_joints();
        let shift = |link: usize| {
            parents[link].map_or_else(Pose::identity, |joint| self.joints[joint].child_pose)
        };
        for (index, link) in robot.links.iter_mut().enumerate() {
            let shift = shift(index);
            link.inertial
                .iter_mut()
                .for_each(|inertial| inertial.pose = shift * inertial.pose);
            link.visuals
                .iter_mut()
                .for_each(|visual| visual.pose = shift * visual.pose);
            link.collisions
                .iter_mut()
                .for_each(|collision| collision.pose = shift * collision.pose);
        }
        for joint in &mut robot.joints {
            joint.origin = shift(joint.parent) * joint.origin;
            joint.child_pose = Pose::identity();
        }
        robot
            .sensors
            .iter_mut()
            .for_each(|sensor| sensor.pose = shift(sensor.link) * sensor.pose);
        robot
    }
}

/// Writes a line. (Writing to a string cannot fail.)
macro_rules! line {
    ($text:expr, $($format:tt)*) => { { let _ = writeln!($text, $($format)*); } };
}

fn write_link(text: &mut String, link: &Link) {
    line!(text, "  <link name=\"{}\">", escaped(&link.name));
    if let Some(inertial) = &link.inertial {
        write_inertial(text, inertial);
    }
    for visual in &link.visuals {
        line!(text, "    <visual{}>", name_attribute(&visual.name));
        write_origin(text, &visual.pose);
        write_geometry(text, &visual.geometry);
        if let Some(material) = &visual.material {
            write_material(text, material, "      ");
        }
        line!(text, "    </visual>");
    }
    for collision in &link.collisions {
        line!(text, "    <collision{}>", name_attribute(&collision.name));
        write_origin(text, &collision.pose);
        write_geometry(text, &collision.geometry);
        line!(text, "    </collision>");
    }
    line!(text, "  </link>");
}

fn write_inertial(text: &mut String, inertial: &Inertial) {
    let [xx, xy, xz, yy, yz, zz] = inertial.inertia;
    line!(text, "    <inertial>");
    write_origin(text, &inertial.pose);
    line!(text, "      <mass value=\"{}\"/>", inertial.mass);
    line!(
        text,
        "      <inertia ixx=\"{xx}\" ixy=\"{xy}\" ixz=\"{xz}\" iyy=\"{yy}\" iyz=\"{yz}\" izz=\"{zz}\"/>"
    );
    line!(text, "    </inertial>");
}

fn write_geometry(text: &mut String, geometry: &Geometry) {
    let element = match geometry {
        Geometry::Box { size: [x, y, z] } => format!("<box size=\"{x} {y} {z}\"/>"),
        Geometry::Cylinder { radius, length } => {
            format!("<cylinder radius=\"{radius}\" length=\"{length}\"/>")
        }
        Geometry::Capsule { radius, length } => {
            format!("<capsule radius=\"{radius}\" length=\"{length}\"/>")
        }
        Geometry::Sphere { radius } => format!("<sphere radius=\"{radius}\"/>"),
        Geometry::Ellipsoid { radii: [x, y, z] } => format!("<ellipsoid radii=\"{x} {y} {z}\"/>"),
        Geometry::Plane { normal: [x, y, z] } => format!("<plane normal=\"{x} {y} {z}\"/>"),
        Geometry::Mesh {
            file,
            scale: [x, y, z],
        } => {
            format!(
                "<mesh filename=\"{}\" scale=\"{x} {y} {z}\"/>",
                escaped(file)
            )
        }
    };
    line!(text, "      <geometry>{element}</geometry>");
}

fn write_material(text: &mut String, material: &Material, indent: &str) {
    line!(
        text,
        "{indent}<material name=\"{}\">",
        escaped(&material.name)
    );
    if let Some([r, g, b, a]) = material.color {
        line!(text, "{indent}  <color rgba=\"{r} {g} {b} {a}\"/>");
    }
    if let Some(file) = &material.texture {
        line!(text, "{indent}  <texture filename=\"{}\"/>", escaped(file));
    }
    line!(text, "{indent}</material>");
}

fn write_joint(text: &mut String, robot: &Robot, joint: &Joint) {
    line!(
        text,
        "  <joint name=\"{}\" type=\"{}\">",
        escaped(&joint.name),
        kind_name(joint.kind)
    );
    line!(
        text,
        "    <parent link=\"{}\"/>",
        escaped(&robot.links[joint.parent].name)
    );
    line!(
        text,
        "    <child link=\"{}\"/>",
        escaped(&robot.links[joint.child].name)
    );
    write_origin(text, &joint.origin);
    if joint.kind != JointKind::Fixed {
        let [x, y, z] = joint.axis;
        line!(text, "    <axis xyz=\"{x} {y} {z}\"/>");
    }
    write_limits(text, joint);
    if joint.dynamics.damping != 0.0 || joint.dynamics.friction != 0.0 {
        line!(
            text,
            "    <dynamics damping=\"{}\" friction=\"{}\"/>",
            joint.dynamics.damping,
            joint.dynamics.friction
        );
    }
    if let Some(mimic) = &joint.mimic {
        let master = escaped(&robot.joints[mimic.joint].name);
        line!(
            text,
            "    <mimic joint=\"{master}\" multiplier=\"{}\" offset=\"{}\"/>",
            mimic.multiplier,
            mimic.offset
        );
    }
    line!(text, "  </joint>");
}

fn write_limits(text: &mut String, joint: &Joint) {
    let limits = &joint.limits;
    let values = [
        ("lower", limits.lower),
        ("upper", limits.upper),
        ("effort", limits.effort),
        ("velocity", limits.velocity),
    ];
    let attributes: String = values
        .iter()
        .filter_map(|(name, value)| value.map(|value| format!(" {name}=\"{value}\"")))
        .collect();
    if !attributes.is_empty() {
        line!(text, "    <limit{attributes}/>");
    }
}

fn kind_name(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Fixed => "fixed",
        JointKind::Revolute => "revolute",
        JointKind::Continuous => "continuous",
        JointKind::Prismatic => "prismatic",
        JointKind::Spherical => "spherical",
        JointKind::Planar => "planar",
        JointKind::Floating => "floating",
    }
}

fn write_origin(text: &mut String, pose: &Pose) {
    if *pose != Pose::identity() {
        let (p, [roll, pitch, yaw]) = (pose.translation.vector, to_rpy(&pose.rotation));
        line!(
            text,
            "      <origin xyz=\"{} {} {}\" rpy=\"{roll} {pitch} {yaw}\"/>",
            p.x,
            p.y,
            p.z
        );
    }
}

fn name_attribute(name: &str) -> String {
    if name.is_empty() {
        String::new()
    } else {
        format!(" name=\"{}\"", escaped(name))
    }
}

/// Text inside of an attribute. Characters that XML does not have are left out.
fn escaped(text: &str) -> String {
    let mut result = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => result.push_str("&lt;"),
            '>' => result.push_str("&gt;"),
            '&' => result.push_str("&amp;"),
            '"' => result.push_str("&quot;"),
            '\t' | '\n' | '\r' => result.push(' '),
            c if c < ' ' || matches!(c, '\u{fffe}' | '\u{ffff}') => {}
            c => result.push(c),
        }
    }
    result
}
