//! MJCF: joints of bodies, defaults, included files, masses of geoms, actuators, constraints, and what is wrong in files.

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
fn actuators_and_constraints_name_what_they_act_on() {
    let model = read(ARM).value;
    let drives: Vec<_> = model
        .actuators
        .iter()
        .map(|actuator| (actuator.joint, actuator.drive, actuator.effort))
        .collect();
    let expected = [
        (
            1,
            Drive::Position {
                stiffness: 200.0,
                damping: 0.0,
            },
            Some(40.0),
        ),
        (2, Drive::Velocity { damping: 7.0 }, None),
        (2, Drive::Force, Some(3.0)),
    ];
    assert_eq!(drives, expected);
    let [
        Equality::Joint {
            joint,
            master,
            polynomial,
            ..
        },
        Equality::Connect { links, points, .. },
        weld,
    ] = model.equalities.as_slice()
    else {
        panic!("{:?}", model.equalities)
    };
    assert_eq!(
        (*joint, *master, *polynomial),
        (2, Some(1), [0.1, 2.0, 0.0, 0.0, 0.0])
    );
    assert_eq!(*links, [4, 5]);
    // The hand is at (-1, 1, 2), the ball at (5, 0, 0).
    assert!((Vector3::from(points[1]) - Vector3::new(-6.0, 1.0, 2.0)).norm() < 1e-12);
    assert!(matches!(weld, Equality::Weld { links: [5, 0], .. }));
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
fn files_are_included_within_limits() {
    let text = "<mujoco><include file='a.xml'/><worldbody/></mujoco>";
    let inner = "<mujocoinclude><worldbody><body name='b'><geom size='-1'/></body></worldbody><include file='a.xml'/>\n<include file='c.xml'/></mujocoinclude>";
    let parsed = read_with(text, vec![("a.xml", inner.to_owned())]);
    assert_eq!(parsed.value.robot.links[1].name, "b");
    let expected = [
        "line 1, <include>: 'a.xml': it includes itself (in a.xml)",
        "line 2, <include>: 'c.xml': it is not there (in a.xml)",
        "line 1, <geom>: a sphere with a size that is not positive; it is left out (in a.xml)",
    ];
    assert_eq!(messages(&parsed), expected);
    let parsed = read_with(
        text,
        vec![("a.xml", "<x><include file='b.xml'/>".to_owned())],
    );
    assert!(messages(&parsed)[0].contains("no valid XML"));
}

/// Names that are taken over by very many parts would take memory that grows with the square of the file.
#[test]
fn very_long_attributes_are_left_out() {
    let long = "x".repeat(300_000);
    let text = format!(
        "<mujoco>\n<asset><mesh name='m' file='{long}'/></asset>\n<worldbody>\n<body name='{long}'>{}</body></worldbody></mujoco>",
        "<joint/><geom mesh='m'/>".repeat(3000)
    );
    let parsed = read(&text);
    assert_eq!(parsed.value.robot.links[3000].name, "body_1");
    let expected = [
        "line 2, <mesh>: file has 300000 bytes, more than the 2000 that are read",
        "line 4, <body>: name has 300000 bytes, more than the 2000 that are read",
        "line 2, <mesh>: a mesh without a file is not read",
    ];
    assert_eq!(messages(&parsed)[..3], expected);
}

/// What is named and what names it are found in time that does not grow with the square of their number.
#[test]
fn very_many_parts_are_read() {
    const COUNT: usize = 40_000;
    let all = |part: &dyn Fn(usize) -> String| (0..COUNT).map(part).collect::<String>();
    let defaults = all(&|n| format!("<geom a{n}='1'/>"));
    let bodies =
        all(&|n| format!("<body name='b{n}'><joint name='j{n}'/><body/><geom size='1'/></body>"));
    let motors = all(&|n| format!("<motor joint='j{n}'/>"));
    let welds = all(&|n| format!("<weld body1='b{n}'/>"));
    let parsed = read(&format!(
        "<mujoco><default>{defaults}</default><worldbody>{bodies}</worldbody><actuator>{motors}</actuator><equality>{welds}</equality></mujoco>"
    ));
    let model = &parsed.value;
    assert_eq!(
        (model.robot.links.len(), model.actuators.len()),
        (2 * COUNT + 1, COUNT)
    );
    assert_eq!(model.equalities.len(), COUNT);
}

#[test]
fn a_mass_that_cannot_be_scaled_stays() {
    let text = "<mujoco>\n<compiler settotalmass='1e30'/><worldbody><body><inertial mass='1e-300'/></body></worldbody></mujoco>";
    let parsed = read(text);
    let inertial = parsed.value.robot.links[1]
        .inertial
        .as_ref()
        .expect("an inertial");
    assert_eq!((inertial.mass, inertial.inertia), (1e-300, [0.0; 6]));
    assert_eq!(
        messages(&parsed),
        ["line 1, <mujoco>: the bodies weigh 1e-300 kg, too little to be scaled to the total mass"]
    );
}

#[test]
fn what_is_not_understood_has_a_line() {
    let text = world(
        "\n<camera/>\n<body euler='1 2'>\n<joint axis='0 0 0'/>\n<joint type='odd' class='none'/>\n<geom type='hfield'/>\n<geom mesh='m'/>\n<geom size='1e400'/></body>",
    );
    let parsed = read(&text.replace("</mujoco>", "\n<tendon/><visual/></mujoco>"));
    let expected = [
        "line 9, <tendon>: <tendon> is not read",
        "line 2, <camera>: <camera> is not read inside of <worldbody>",
        "line 3, <body>: euler has 2 numbers instead of 3",
        "line 4, <joint>: an axis without length: z is taken",
        "line 5, <joint>: there is no class 'none'",
        "line 5, <joint>: the type 'odd' is not known: it is taken for a hinge",
        "line 6, <geom>: a geom of type 'hfield' is not read",
        "line 7, <geom>: there is no mesh 'm'",
        "line 8, <geom>: size has '1e400', which is no number",
        "line 8, <geom>: a sphere with too few sizes; it is left out",
    ];
    assert_eq!(messages(&parsed), expected);
}

#[test]
fn other_files_are_refused() {
    let refused =
        |text: &str| mjcf::read(text.as_bytes(), &mut Texts(Vec::new())).expect_err("it is none");
    assert!(matches!(
        refused("<robot/>"),
        ReadError::WrongRoot { line: 1, .. }
    ));
    assert!(matches!(refused("<mujoco>"), ReadError::Xml(_)));
    let bomb = "<!DOCTYPE m [<!ENTITY a 'aaaa'>]><mujoco>&a;</mujoco>";
    assert!(matches!(refused(bomb), ReadError::Entities { line: 1 }));
    let deep = format!(
        "<mujoco><worldbody>{}{}</worldbody></mujoco>",
        "<body>".repeat(300),
        "</body>".repeat(300)
    );
    let parsed = read(&deep);
    assert!(messages(&parsed)[0].contains("elements inside of each other"));
    assert!(mjcf::is_mjcf(
        b"\xef\xbb\xbf<?xml version='1.0'?>\n<!-- > -->\n<mujoco model='a'>"
    ));
    assert!(
        mjcf::is_mjcf(b"<mujoco/>")
            && !mjcf::is_mjcf(b"<mujocoinclude/>")
            && !mjcf::is_mjcf(b"<!-- <mujoco>")
    );
}

#[test]
fn an_actuator_acts_through_its_gear_within_its_ranges() {
    let text = r#"<mujoco><worldbody><body><joint name="a" damping="2" armature="3" frictionloss="4" stiffness="5" springref="90"/><geom size="1"/>
        <body><joint name="b"/><geom size="1"/></body></body></worldbody><actuator>
        <motor joint="a" gear="-20" ctrlrange="-1 2" forcerange="-1.5 1.5"/>
        <general joint="b" gear="2" gainprm="30" biastype="affine" biasprm="1 -10 -3" ctrlrange="-1 1" forcerange="-4 5"/>
        <velocity joint="b" kv="7" gear="3" ctrlrange="-6 3"/></actuator></mujoco>"#;
    let model = read(text).value;
    let dynamics = model.robot.joints[0].dynamics;
    let numbers = [
        dynamics.damping,
        dynamics.armature,
        dynamics.friction,
        dynamics.stiffness,
    ];
    assert_eq!(numbers, [2.0, 3.0, 4.0, 5.0]);
    assert!((dynamics.rest - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    let [motor, general, velocity] = model.actuators.as_slice() else {
        panic!("three actuators")
    };
    assert_eq!((motor.drive, motor.bias), (Drive::Force, 0.0));
    assert_eq!((motor.range, motor.control), (Some([-30.0, 20.0]), None));
    let spring = Drive::Position {
        stiffness: 40.0,
        damping: 12.0,
    };
    assert_eq!((general.drive, general.bias), (spring, 2.0));
    assert_eq!(general.range, Some([-8.0, 10.0]));
    // A unit of what it is told is 60 N m, as much as 1.5 rad.
    assert_eq!(general.control, Some([-1.5, 1.5]));
    assert_eq!(velocity.drive, Drive::Velocity { damping: 63.0 });
    assert_eq!(velocity.control, Some([-2.0, 1.0]));
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

#[test]
fn actuators_inherit_the_range_of_their_joint() {
    let text = "<mujoco><compiler angle='radian'/><worldbody><body><joint name='j' range='1 3'/><geom size='1'/></body></worldbody>
        <actuator><position joint='j' inheritrange='.5'/><position joint='j' inheritrange='1' ctrlrange='0 1'/><position joint='j'/></actuator></mujoco>";
    let ranges: Vec<_> = read(text)
        .value
        .actuators
        .iter()
        .map(|actuator| actuator.control)
        .collect();
    assert_eq!(ranges, [Some([1.5, 2.5]), Some([0.0, 1.0]), None]);
}

#[test]
fn bodies_adhere_float_and_have_belts() {
    let text = "<mujoco><worldbody>
        <geom name='floor' type='plane' size='5 5 1'/>
        <body name='belt' pos='1 0 0'><geom type='box' size='1 1 1' pos='0 2 0' euler='0 0 90' surfacevel='.5 0 0 0 0 1'/></body>
        <body name='two'><geom size='1' surfacevel='1 0 0 0 0 0'/><geom size='2'/></body>
        <body name='ball' gravcomp='.5'><freejoint/><geom size='1' surfacevel='1 0 0 0 0 0' adhesion='3'/></body>
        </worldbody><actuator><adhesion name='grip' body='ball' gain='4' ctrlrange='0 2' forcerange='0 6'/><adhesion body='nobody'/><adhesion/></actuator></mujoco>";
    let parsed = read(text);
    let model = &parsed.value;
    let named = |name: &str| {
        let mut links = model.robot.links.iter();
        links.position(|link| link.name == name).expect("a link")
    };
    assert_eq!(model.compensations, [(named("ball"), 0.5)]);
    let [(belt, motion)] = model.moving_surfaces[..] else {
        panic!("{:?}", model.moving_surfaces);
    };
    // It turns about its own middle, two metres along y: there the surface goes along y with 0.5 m/s.
    let expected = [2.0, 0.5, 0.0, 0.0, 0.0, 1.0];
    assert_eq!(belt, named("belt"));
    let close = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-12;
    assert!(motion.iter().zip(&expected).all(close), "{motion:?}");
    let [adhesion] = &model.adhesions[..] else {
        panic!("{:?}", model.adhesions);
    };
    assert_eq!(
        (adhesion.name.as_str(), adhesion.link),
        ("grip", named("ball"))
    );
    assert_eq!(
        (adhesion.gain, adhesion.control, adhesion.force),
        (4.0, Some([0.0, 2.0]), Some([0.0, 6.0]))
    );
    let left_out = [
        "another geom of the body",
        "of bodies that move",
        "adhesion of geoms",
        "no body 'nobody'",
        "it names no body",
    ];
    let warnings: Vec<String> = parsed.warnings.iter().map(ToString::to_string).collect();
    for reason in left_out {
        let named = |warning: &&String| warning.contains(reason);
        assert_eq!(
            warnings.iter().filter(named).count(),
            1,
            "{reason}: {warnings:?}"
        );
    }
}
