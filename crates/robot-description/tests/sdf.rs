//! SDF: poses in other frames, models inside of models, includes, and what is wrong in files.

use robot_description::sdf::{self, Included, World};
use robot_description::{Geometry, JointKind, Parsed, ReadError};
use test_support::random::Random;

const ARM: &str = r#"<?xml version="1.0"?>
<sdf version="1.9">
  <world name="w">
    <gravity>0 0 -1.62</gravity>
    <frame name="table"><pose>0 0 1 0 0 0</pose></frame>
    <model name="arm">
      <pose relative_to="table">1 0 0 0 0 1.5707963267948966</pose>
      <link name="base">
        <inertial><mass>2</mass><pose>0 0 0.1 0 0 0</pose><inertia><ixx>0.1</ixx><iyy>0.2</iyy><izz>0.3</izz></inertia></inertial>
        <visual name="v"><geometry><mesh><uri>meshes/a.dae</uri><scale>1 2 3</scale></mesh></geometry><material><diffuse>1 0 0 1</diffuse></material></visual>
        <collision name="c"><pose>0 0 0.5 0 0 0</pose><geometry><box><size>1 2 3</size></box></geometry></collision>
        <sensor name="eye" type="camera"><camera><horizontal_fov>1.2</horizontal_fov><image><width>320</width><height>200</height></image><clip><near>0.2</near><far>9</far></clip></camera></sensor>
      </link>
      <link name="fore"><pose relative_to="elbow">0 0 0.5 0 0 0</pose></link>
      <joint name="elbow" type="revolute">
        <pose relative_to="base">0 0 2 0 0 0</pose><parent>base</parent><child>fore</child>
        <axis><xyz expressed_in="__model__">0 1 0</xyz><limit><lower>-1</lower><upper>2</upper><effort>5</effort></limit><dynamics><damping>0.5</damping></dynamics></axis>
      </joint>
      <model name="hand"><pose relative_to="fore">0 0 1 0 0 0</pose>
        <link name="palm"/><frame name="tip" attached_to="palm"><pose>0.1 0 0 0 0 0</pose></frame>
      </model>
      <joint name="wrist" type="universal"><parent>fore</parent><child>hand::tip</child>
        <axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2></joint>
    </model>
  </world>
</sdf>"#;

fn nothing(uri: &str) -> Result<Included, String> {
    Err(format!("{uri} is not there"))
}

fn read(text: &str) -> Parsed<World> {
    sdf::read(text.as_bytes(), &mut nothing).expect("it is SDF")
}

fn model(inside: &str) -> String {
    format!("<sdf version='1.9'><model name='m'>{inside}</model></sdf>")
}

#[test]
fn a_world_is_read_whole() {
    let parsed = read(ARM);
    assert_eq!(parsed.warnings, []);
    let world = parsed.value;
    assert_eq!(
        (world.name.as_str(), world.gravity),
        ("w", Some([0.0, 0.0, -1.62]))
    );
    let arm = &world.models[0];
    assert!((arm.pose.translation.vector - nalgebra::Vector3::new(1.0, 0.0, 1.0)).norm() < 1e-15);
    let robot = &arm.robot;
    let names: Vec<&str> = robot.links.iter().map(|link| link.name.as_str()).collect();
    assert_eq!(names, ["base", "fore", "hand::palm", "wrist_cross"]);
    let base = &robot.links[0];
    let inertial = base.inertial.as_ref().expect("the base has one");
    assert_eq!(
        (inertial.mass, inertial.inertia),
        (2.0, [0.1, 0.0, 0.0, 0.2, 0.0, 0.3])
    );
    assert_eq!(
        base.visuals[0].geometry,
        Geometry::Mesh {
            file: "meshes/a.dae".into(),
            scale: [1.0, 2.0, 3.0]
        }
    );
    assert_eq!(
        base.collisions[0].geometry,
        Geometry::Box {
            size: [1.0, 2.0, 3.0]
        }
    );
    assert_eq!(robot.sensors[0].name, "eye");
    let elbow = &robot.joints[0];
    assert_eq!(
        (elbow.kind, elbow.limits.effort, elbow.dynamics.damping),
        (JointKind::Revolute, Some(5.0), 0.5)
    );
    assert_eq!(robot.joints[1].kind, JointKind::Continuous);
}

#[test]
fn links_are_where_their_poses_say() {
    let world = read(ARM).value;
    let robot = &world.models[0].robot;
    let at_zero = robot.link_poses(&[0.0, 0.0, 0.0]).expect("three axes");
    for (link, pose) in robot.links.iter().zip(&at_zero) {
        assert!(
            (link.pose.inverse() * pose).translation.vector.norm() < 1e-14,
            "{}",
            link.name
        );
    }
    assert!(
        (at_zero[1].translation.z - 2.5).abs() < 1e-14
            && (at_zero[2].translation.z - 3.5).abs() < 1e-14
    );
    // The elbow turns about y of the model: z becomes x.
    let bent = robot
        .link_poses(&[std::f64::consts::FRAC_PI_2, 0.0, 0.0])
        .expect("three axes");
    assert!((bent[1].translation.vector - nalgebra::Vector3::new(0.5, 0.0, 2.0)).norm() < 1e-14);
    // The wrist is at the tip, 0.1 beside the palm.
    let turned = robot
        .link_poses(&[0.0, 0.0, std::f64::consts::FRAC_PI_2])
        .expect("three axes");
    assert!((turned[2].translation.vector - nalgebra::Vector3::new(0.1, 0.0, 3.6)).norm() < 1e-14);
}

#[test]
fn files_are_included_with_other_names_poses_and_folders() {
    let inner = "<sdf version='1.6'><model name='box'><link name='l'><visual name='v'><geometry><mesh><uri>x.stl</uri></mesh></geometry></visual></link></model></sdf>";
    let mut include = |uri: &str| match uri {
        "model://box" => Ok(Included {
            bytes: inner.into(),
            folder: "/models/box".into(),
        }),
        other => nothing(other),
    };
    let text = "<sdf version='1.9'><world name='w'><include><uri>model://box</uri><name>first</name><pose>1 0 0 0 0 0</pose><static>1</static></include>\n<include><uri>gone</uri></include></world></sdf>";
    let parsed = sdf::read(text.as_bytes(), &mut include).expect("it is SDF");
    let first = &parsed.value.models[0];
    assert_eq!(
        (
            first.robot.name.as_str(),
            first.is_static,
            first.pose.translation.x
        ),
        ("first", true, 1.0)
    );
    assert_eq!(
        first.robot.links[0].visuals[0].geometry,
        Geometry::Mesh {
            file: "/models/box/x.stl".into(),
            scale: [1.0; 3]
        }
    );
    assert_eq!(
        parsed
            .warnings
            .iter()
            .map(ToString::to_string)
            .collect::<Vec<_>>(),
        ["line 2, <include>: 'gone': gone is not there"]
    );
}

#[test]
fn files_that_include_themselves_or_too_many_end() {
    let itself = model("<include><uri>x</uri></include>");
    let mut include = |_: &str| {
        Ok(Included {
            bytes: itself.clone().into(),
            folder: String::new(),
        })
    };
    let parsed = sdf::read(itself.as_bytes(), &mut include).expect("it is SDF");
    assert!(
        parsed
            .warnings
            .iter()
            .any(|warning| warning.message.contains("includes itself"))
    );
    let mut count = 0;
    let mut always_new = |_: &str| {
        count += 1;
        let inside =
            format!("<include><uri>{count}</uri></include><include><uri>b{count}</uri></include>")
                .repeat(20);
        Ok(Included {
            bytes: model(&inside).into(),
            folder: String::new(),
        })
    };
    sdf::read(itself.as_bytes(), &mut always_new).expect("it is SDF");
    assert!(count <= 1000, "{count}");
}

#[test]
fn frames_that_are_defined_in_themselves_or_in_nothing_are_reported() {
    let circle = model(
        "<link name='a'><pose relative_to='b'>1 0 0 0 0 0</pose></link><link name='b'><pose relative_to='a'/></link>",
    );
    assert!(
        read(&circle)
            .warnings
            .iter()
            .any(|warning| warning.message.contains("defined in itself"))
    );
    let unknown = read(&model(
        "<link name='a'><pose relative_to='x'>1 0 0 0 0 0</pose></link>",
    ));
    assert!(unknown.warnings[0].message.contains("no frame 'x'"));
    assert_eq!(
        unknown.value.models[0].robot.links[0].pose.translation.x,
        1.0
    );
    let lost = read(&model(
        "<link name='a'/><joint name='j' type='fixed'><parent>a</parent><child>x</child></joint>",
    ));
    assert!(
        lost.warnings
            .iter()
            .any(|warning| warning.message.contains("no link 'x'"))
    );
}

#[test]
fn models_with_very_long_names_are_left_out() {
    let links = "<link name='a'/>".repeat(10_000);
    let long = "x".repeat(300_000);
    let parsed = read(&format!(
        "<sdf version='1.9'>\n<model name='{long}'>{links}</model>\n<model name='m'/></sdf>"
    ));
    assert_eq!(
        parsed
            .value
            .models
            .iter()
            .map(|model| model.robot.name.as_str())
            .collect::<Vec<_>>(),
        ["m"]
    );
    assert_eq!(parsed.warnings[0].line, 2);
    assert!(
        parsed.warnings[0].message.contains("name is too long"),
        "{}",
        parsed.warnings[0]
    );
}

#[test]
fn very_many_models_are_read_in_time_that_grows_with_their_number() {
    let models = |place: &str| -> String {
        (0..50_000)
            .map(|n| format!("<model name='m{n}'><link name='a'/>{place}</model>"))
            .collect()
    };
    let worlds = read(&format!("<sdf version='1.9'>{}</sdf>", models("")));
    assert_eq!(worlds.value.models.len(), 50_000);
    let nested = read(&model(&models("<frame name='f'/>")));
    assert_eq!(nested.value.models[0].robot.links.len(), 50_000);
}

#[test]
fn a_nested_model_of_the_same_name_changes_nothing_of_the_first() {
    let inner = |link: &str| format!("<model name='n'><link name='{link}'/></model>");
    let joint = "<joint name='j' type='fixed'><parent>a</parent><child>n</child></joint>";
    let parsed = read(&model(&format!(
        "<link name='a'/>{}{}{joint}",
        inner("b"),
        inner("c")
    )));
    let robot = &parsed.value.models[0].robot;
    assert_eq!(robot.links[robot.joints[0].child].name, "n::b");
}

#[test]
fn joints_that_mimic_each_other_are_reported() {
    let joint = |name: &str, child: &str, master: &str| {
        format!(
            "<link name='{child}'/><joint name='{name}' type='revolute'><parent>a</parent><child>{child}</child>\
             <axis><mimic joint='{master}'><multiplier>2</multiplier></mimic></axis></joint>"
        )
    };
    let parsed = read(&model(&format!(
        "<link name='a'/>{}{}",
        joint("j", "b", "k"),
        joint("k", "c", "j")
    )));
    let message = "joint 'j' (line 1) mimics joints without end; it moves by itself";
    assert_eq!(
        parsed
            .warnings
            .iter()
            .map(|warning| warning.message.as_str())
            .collect::<Vec<_>>(),
        [message]
    );
    let joints = &parsed.value.models[0].robot.joints;
    assert!(joints[0].mimic.is_none());
    assert_eq!(joints[1].mimic.map(|mimic| mimic.joint), Some(0));
}

#[test]
fn a_joint_may_hold_a_link_to_the_world() {
    let robot = read(&model(
        "<pose>0 0 3 0 0 0</pose><link name='a'/><joint name='j' type='fixed'><parent>world</parent><child>a</child></joint>",
    ));
    let robot = &robot.value.models[0].robot;
    assert_eq!(
        (
            robot.links[1].name.as_str(),
            robot.links[1].pose.translation.z
        ),
        ("world", -3.0)
    );
    assert_eq!(
        robot.link_poses(&[]).expect("no positions")[0]
            .translation
            .z,
        0.0
    );
}

#[test]
fn axes_of_old_files_are_those_of_the_model() {
    let text = |version: &str| {
        format!(
            "<sdf version='{version}'><model name='m'><link name='a'/><link name='b'><pose>0 0 0 0 1.5707963267948966 0</pose></link><joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint></model></sdf>"
        )
    };
    let axis = |version| read(&text(version)).value.models[0].robot.joints[0].axis;
    assert!((axis("1.4")[0] + 1.0).abs() < 1e-15, "{:?}", axis("1.4"));
    assert_eq!(axis("1.6"), [0.0, 0.0, 1.0]);
}

#[test]
fn a_model_can_be_placed_by_one_of_its_frames() {
    let text = "<sdf version='1.9'><model name='m' placement_frame='b'><pose>5 0 0 0 0 0</pose><link name='a'/><link name='b'><pose>1 0 0 0 0 0</pose></link></model></sdf>";
    assert!((read(text).value.models[0].pose.translation.x - 4.0).abs() < 1e-15);
}

#[test]
fn what_is_no_sdf_is_refused_and_files_cut_anywhere_do_no_harm() {
    assert!(matches!(
        sdf::read(b"<robot/>", &mut nothing),
        Err(ReadError::WrongRoot { .. })
    ));
    for end in 0..ARM.len() {
        assert!(
            sdf::read(&ARM.as_bytes()[..end], &mut nothing).is_err(),
            "{end}"
        );
    }
    let mut random = Random::new(7);
    let mut below = |bound| random.below(bound);
    let mut read_ones = 0;
    for _ in 0..3000 {
        let mut bytes = ARM.as_bytes().to_vec();
        let (at, from, length) = (below(bytes.len()), below(bytes.len()), below(30));
        let piece = bytes[from..(from + length).min(bytes.len())].to_vec();
        match below(3) {
            0 => bytes[at] = below(256) as u8,
            1 => drop(bytes.splice(at..at, piece)),
            _ => drop(bytes.drain(at..(at + length).min(bytes.len()))),
        }
        let Ok(parsed) = sdf::read(&bytes, &mut nothing) else {
            continue;
        };
        read_ones += 1;
        for model in parsed.value.models {
            let poses = model
                .robot
                .link_poses(&model.robot.zero_positions())
                .expect("as many as joints");
            assert_eq!(poses.len(), model.robot.links.len());
        }
    }
    assert!(read_ones > 100, "{read_ones}");
}
