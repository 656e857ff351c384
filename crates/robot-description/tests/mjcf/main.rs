//! MJCF: joints of bodies, defaults, masses of geoms, orientations, options; actuators and constraints, limits and faults of files, and what touches are in the other files.

mod actuators;
mod faults;
mod tendons;
mod touching;

use nalgebra::Vector3;
use robot_description::mjcf::{self, Drive, Equality, Files, Model, Triangles};
use robot_description::{Geometry, JointKind, Parsed, ReadError};

const ARM: &str = r#"<!-- an arm -->
<mujoco model="arm">
  <compiler angle="radian" meshdir="meshes" autolimits="true"/>
  <option gravity="0 0 -1.62"/>
  <default>
    <geom rgba="1 0 0 1"/>
    <default class="strong">
      <joint damping="3" range="-1 2"/>
      <position kp="50" forcerange="-20 20"/>
    </default>
  </default>
  <asset>
    <mesh file="hand.stl" scale="2 2 2"/>
    <material name="blue" rgba="0 0 1 1"/>
  </asset>
  <worldbody>
    <geom type="plane" size="1 1 .1"/>
    <body name="base" pos="0 0 1" quat="1 0 0 1">
      <geom type="box" size=".1 .2 .3" mass="2" group="3"/>
      <body name="upper" pos="1 0 0" childclass="strong">
        <joint name="shoulder" axis="0 0 2" pos="0 0.5 0" ref="0.5"/>
        <joint name="lift" type="slide" axis="1 0 0"/>
        <inertial pos="0 0 .1" mass="3" fullinertia="1 2 3 .1 .2 .3"/>
        <geom type="capsule" fromto="0 0 0 0 0 1" size=".1" contype="0" conaffinity="0" material="blue"/>
        <site name="grip" pos="0 0 1"/>
        <frame pos="0 0 1" euler="0 0 1.5707963267948966">
          <body name="hand" pos="1 0 0"><joint name="turn" type="ball"/><geom type="mesh" mesh="hand"/></body>
        </frame>
      </body>
    </body>
    <body name="ball" pos="5 0 0"><freejoint/><geom size=".1" density="500"/></body>
  </worldbody>
  <actuator>
    <position name="servo" joint="shoulder" class="strong" gear="2"/>
    <velocity joint="lift" kv="7"/>
    <motor joint="lift" ctrlrange="-3 3"/>
    <muscle joint="lift"/>
  </actuator>
  <equality>
    <joint joint1="lift" joint2="shoulder" polycoef="0.1 2 0 0 0"/>
    <connect body1="hand" body2="ball" anchor="0 0 0"/>
    <weld body1="ball"/>
  </equality>
</mujoco>"#;

/// Files that are texts, and a mesh: a tetrahedron with edges of 1 along the axes.
struct Texts(Vec<(&'static str, String)>);

impl Files for Texts {
    fn include(&mut self, name: &str) -> Result<Vec<u8>, String> {
        let found = self.0.iter().find(|(file, _)| *file == name);
        found
            .map(|(_, text)| text.clone().into_bytes())
            .ok_or_else(|| "it is not there".to_owned())
    }

    fn triangles(&mut self, file: &str) -> Result<Triangles, String> {
        if file != "meshes/hand.stl" {
            return Err(format!("{file} is not there"));
        }
        let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Ok(Triangles {
            vertices,
            corners: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        })
    }
}

fn read(text: &str) -> Parsed<Model> {
    read_with(text, Vec::new())
}

fn read_with(text: &str, files: Vec<(&'static str, String)>) -> Parsed<Model> {
    mjcf::read(text.as_bytes(), &mut Texts(files)).expect("it is MJCF")
}

fn world(inside: &str) -> String {
    format!("<mujoco><worldbody>{inside}</worldbody></mujoco>")
}

fn messages(parsed: &Parsed<Model>) -> Vec<String> {
    parsed.warnings.iter().map(ToString::to_string).collect()
}

#[test]
fn an_arm_is_read_whole() {
    let parsed = read(ARM);
    assert_eq!(
        messages(&parsed),
        ["line 37, <muscle>: an actuator of type 'muscle' is not read"]
    );
    let model = parsed.value;
    assert_eq!(
        (model.robot.name.as_str(), model.gravity),
        ("arm", Some([0.0, 0.0, -1.62]))
    );
    let names: Vec<&str> = model
        .robot
        .links
        .iter()
        .map(|link| link.name.as_str())
        .collect();
    assert_eq!(names, ["world", "base", "upper_1", "upper", "hand", "ball"]);
    assert_eq!(model.fixed, [0, 1]);
    assert!(matches!(
        model.robot.links[0].collisions[0].geometry,
        Geometry::Plane { .. }
    ));
    let joints: Vec<_> = model
        .robot
        .joints
        .iter()
        .map(|joint| (joint.name.as_str(), joint.kind))
        .collect();
    let expected = [
        ("base_fixed", JointKind::Fixed),
        ("shoulder", JointKind::Revolute),
        ("lift", JointKind::Prismatic),
        ("turn", JointKind::Spherical),
    ];
    assert_eq!(joints, expected);
    let shoulder = &model.robot.joints[1];
    assert_eq!(
        (
            shoulder.limits.lower,
            shoulder.limits.upper,
            shoulder.reference
        ),
        (Some(-1.0), Some(2.0), 0.5)
    );
    assert_eq!(shoulder.dynamics.damping, 3.0);
}

#[test]
fn looks_and_collisions_are_told_apart() {
    let robot = read(ARM).value.robot;
    // Group 3 is not shown, contype and conaffinity 0 are not touched.
    assert_eq!(
        (
            robot.links[1].visuals.len(),
            robot.links[1].collisions.len()
        ),
        (0, 1)
    );
    assert_eq!(
        (
            robot.links[3].visuals.len(),
            robot.links[3].collisions.len()
        ),
        (1, 0)
    );
    let seen = &robot.links[3].visuals[0];
    assert_eq!(
        seen.geometry,
        Geometry::Capsule {
            radius: 0.1,
            length: 1.0
        }
    );
    assert!((seen.pose.translation.vector - Vector3::new(0.0, 0.0, 0.5)).norm() < 1e-15);
    // The default colour is nearer than that of the material.
    assert_eq!(
        seen.material.as_ref().and_then(|material| material.color),
        Some([1.0, 0.0, 0.0, 1.0])
    );
    assert_eq!(
        robot.links[4].visuals[0].geometry,
        Geometry::Mesh {
            file: "meshes/hand.stl".into(),
            scale: [2.0; 3]
        }
    );
}

#[test]
fn joints_turn_about_their_anchors_from_their_references() {
    let model = read(ARM).value;
    let robot = &model.robot;
    let poses = |shoulder: f64, lift: f64| {
        robot
            .link_poses(&[shoulder, lift, 0.0, 0.0, 0.0, 1.0])
            .expect("as many positions as the joints have")
    };
    // At the reference of the shoulder the arm is where the file has it; the base is turned by a quarter about z.
    let at_first = poses(0.5, 0.0);
    assert!((at_first[3].translation.vector - Vector3::new(0.0, 1.0, 1.0)).norm() < 1e-12);
    assert!((at_first[4].translation.vector - Vector3::new(-1.0, 1.0, 2.0)).norm() < 1e-12);
    // Half a turn about the anchor, then along the turned x axis.
    let turned = poses(0.5 + std::f64::consts::PI, 2.0);
    assert!(
        (turned[3].translation.vector - Vector3::new(-1.0, -1.0, 1.0)).norm() < 1e-12,
        "{}",
        turned[3]
    );
    assert_eq!(model.sites[0].link, 3);
}

#[test]
fn bodies_weigh_what_is_said_or_what_their_geoms_do() {
    let robot = read(ARM).value.robot;
    let inertial = |link: usize| robot.links[link].inertial.clone().expect("it has mass");
    assert_eq!(
        (inertial(3).mass, inertial(3).inertia),
        (3.0, [1.0, 0.1, 0.2, 2.0, 0.3, 3.0])
    );
    // A box of 0.2 x 0.4 x 0.6 with 2 kg.
    let base = inertial(1);
    assert!(
        (base.mass - 2.0).abs() < 1e-15
            && (base.inertia[0] - 2.0 / 12.0 * (0.16 + 0.36)).abs() < 1e-15
    );
    // A tetrahedron with edges of 2 m: a sixth of 8 m³ of water; its inertia about x at the centre is 3/80 m a² of the regular corner.
    let hand = inertial(4);
    assert!((hand.mass - 8000.0 / 6.0).abs() < 1e-9);
    assert!((hand.pose.translation.vector - Vector3::repeat(0.5)).norm() < 1e-12);
    assert!(
        (hand.inertia[0] - hand.mass * 4.0 * 3.0 / 40.0).abs() < 1e-9,
        "{}",
        hand.inertia[0]
    );
    let ball = inertial(5);
    assert!((ball.mass - 500.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-3).abs() < 1e-12);
    assert_eq!(robot.links[2].inertial, None);
}

#[test]
fn angles_and_orientations_are_read_as_the_settings_say() {
    let bodies = |settings: &str, text: &str| {
        let text =
            format!("<mujoco><compiler {settings}/><worldbody><body {text}/></worldbody></mujoco>");
        let robot = read(&text).value.robot;
        robot.link_poses(&[]).expect("no joints")[1].rotation
    };
    let quarter =
        nalgebra::UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
    for (settings, text) in [
        ("", "euler='0 0 90'"),
        ("angle='radian'", "axisangle='0 0 2 1.5707963267948966'"),
        ("", "xyaxes='0 2 0 -1 5 0'"),
        ("", "quat='3 0 0 3'"),
        ("eulerseq='ZYX'", "euler='90 0 0'"),
    ] {
        assert!(
            bodies(settings, text).angle_to(&quarter) < 1e-12,
            "{settings} {text}"
        );
    }
    // Small letters: about turned axes; capital ones: about fixed ones.
    let (turned, fixed) = (
        bodies("", "euler='90 90 0'"),
        bodies("eulerseq='XYZ'", "euler='90 90 0'"),
    );
    assert!((turned * Vector3::z() - Vector3::x()).norm() < 1e-12);
    assert!((fixed * Vector3::z() - Vector3::new(0.0, -1.0, 0.0)).norm() < 1e-12);
    let along = bodies("", "zaxis='1 0 0'");
    assert!((along * Vector3::z() - Vector3::x()).norm() < 1e-12);
}

#[test]
fn gravity_and_fluids_are_options() {
    let option = |text: &str| read(&format!("<mujoco>{text}<worldbody/></mujoco>")).value;
    let model = option("<option density='1.2' gravity='0 0 -2'/><option viscosity='3'/>");
    assert_eq!(
        (model.fluid, model.gravity),
        ([1.2, 3.0], Some([0.0, 0.0, -2.0]))
    );
    let off = option("<option gravity='0 0 -2'><flag gravity='disable'/></option>");
    assert_eq!((off.fluid, off.gravity), ([0.0; 2], Some([0.0; 3])));
}
