//! URDF: what is read, what is corrected, what is refused, and what is written.

use robot_description::{
    Geometry, JointKind, Parsed, ReadError, Robot, SensorKind, WarningKind, urdf,
};
use test_support::random::Random;

const ARM: &str = r#"<?xml version="1.0"?>
<robot name="arm">
  <material name="blue"><color rgba="0 0 1 0.5"/></material>
  <link name="base">
    <inertial><origin xyz="0 0 0.1" rpy="0 0 1.5707963267948966"/><mass value="2.5"/><inertia ixx="0.1" ixy="0.01" ixz="0.02" iyy="0.2" iyz="0.03" izz="0.3"/></inertial>
    <visual name="v"><origin xyz="1 2 3"/><geometry><mesh filename="package://arm/base.stl" scale="1 -1 0.5"/></geometry><material name="blue"/></visual>
    <collision><geometry><box size="0.1 0.2 0.3"/></geometry></collision>
  </link>
  <link name="upper"><collision><geometry><cylinder radius="0.1" length="2"/></geometry></collision></link>
  <link name="fore"><collision><geometry><sphere radius="0.3"/></geometry></collision></link>
  <link name="finger"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/><origin xyz="0 0 1" rpy="0 1.5707963267948966 0"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="2" effort="10" velocity="3"/><dynamics damping="0.5" friction="0.25"/>
  </joint>
  <joint name="slide" type="prismatic"><parent link="upper"/><child link="fore"/><axis xyz="0 2 0"/></joint>
  <joint name="grip" type="continuous"><parent link="fore"/><child link="finger"/><mimic joint="slide" multiplier="-2" offset="0.5"/></joint>
  <sensor name="eye"><parent link="fore"/><origin xyz="0 0 0.2"/><camera><image width="320" height="200" hfov="1.2" near="0.1" far="5"/></camera></sensor>
</robot>"#;

fn read(text: &str) -> Parsed<Robot> {
    urdf::read(text.as_bytes()).expect("it is a robot")
}

/// The warnings of a robot with these elements inside.
fn warnings(elements: &str) -> Vec<String> {
    let parsed = read(&format!(
        "<robot name='r'><link name='a'/><link name='b'/>\n{elements}</robot>"
    ));
    parsed.warnings.iter().map(ToString::to_string).collect()
}

#[test]
fn a_robot_is_read_whole() {
    let parsed = read(ARM);
    assert_eq!(parsed.warnings, []);
    let robot = parsed.value;
    assert_eq!(
        (robot.name.as_str(), robot.links.len(), robot.joints.len()),
        ("arm", 4, 3)
    );
    let base = &robot.links[0];
    let inertial = base.inertial.as_ref().expect("the base has one");
    assert_eq!(
        (inertial.mass, inertial.inertia),
        (2.5, [0.1, 0.01, 0.02, 0.2, 0.03, 0.3])
    );
    assert!((inertial.pose.rotation.angle() - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    assert_eq!(
        base.visuals[0].geometry,
        Geometry::Mesh {
            file: "package://arm/base.stl".into(),
            scale: [1.0, -1.0, 0.5]
        }
    );
    assert_eq!(
        robot
            .material_of(&base.visuals[0])
            .and_then(|material| material.color),
        Some([0.0, 0.0, 1.0, 0.5])
    );
    let shoulder = &robot.joints[0];
    assert_eq!(
        (shoulder.kind, shoulder.limits.lower, shoulder.limits.upper),
        (JointKind::Revolute, Some(-1.0), Some(2.0))
    );
    assert_eq!(
        (shoulder.dynamics.damping, shoulder.dynamics.friction),
        (0.5, 0.25)
    );
    let eye = &robot.sensors[0];
    assert_eq!(eye.link, 2);
    assert_eq!(
        eye.kind,
        SensorKind::Camera {
            resolution: [320, 200],
            angle: 1.2,
            clip: [0.1, 5.0]
        }
    );
}

#[test]
fn links_move_with_their_joints() {
    let robot = read(ARM).value;
    let poses = robot.link_poses(&[0.0, 0.25, 9.0]).expect("three joints");
    // The shoulder turns z into x; the slide moves along y, a unit per metre whatever the length of its axis.
    assert!((poses[2].translation.vector - nalgebra::Vector3::new(0.0, 0.25, 1.0)).norm() < 1e-12);
    // grip = -2 * 0.25 + 0.5
    assert!(poses[2].rotation.angle_to(&poses[3].rotation) < 1e-12);
    let error = robot.link_poses(&[0.0]).expect_err("too few");
    assert_eq!(
        error.to_string(),
        "the joints of 'arm' have 3 positions, not 1"
    );
}

#[test]
fn what_is_written_is_read_again() {
    let robot = read(ARM).value;
    let text = urdf::write(&robot);
    let again = read(&text).value;
    let positions = [0.3, 0.1, 0.0];
    let (before, after) = (
        robot.link_poses(&positions).unwrap(),
        again.link_poses(&positions).unwrap(),
    );
    for (a, b) in before.iter().zip(&after) {
        assert!(
            (a.inverse() * b).translation.vector.norm() < 1e-14
                && a.rotation.angle_to(&b.rotation) < 1e-14
        );
    }
    assert_eq!(
        robot.links[0]
            .inertial
            .as_ref()
            .map(|i| (i.mass, i.inertia)),
        again.links[0]
            .inertial
            .as_ref()
            .map(|i| (i.mass, i.inertia))
    );
    assert_eq!(
        robot.links[0].visuals[0].geometry,
        again.links[0].visuals[0].geometry
    );
    assert_eq!(robot.joints[0].limits, again.joints[0].limits);
    assert_eq!(robot.joints[2].mimic, again.joints[2].mimic);
    assert_eq!(text, urdf::write(&again));
}

#[test]
fn names_with_marks_are_written_so_that_they_are_read() {
    let mut robot = read(ARM).value;
    robot.name = "a<b>&\"c\"\u{1}".to_owned();
    assert_eq!(read(&urdf::write(&robot)).value.name, "a<b>&\"c\"");
}

#[test]
fn frames_of_links_become_those_of_their_joints() {
    let mut robot = read(ARM).value;
    robot.joints[0].child_pose = nalgebra::Isometry3::translation(0.0, 0.5, 0.0);
    let written = read(&urdf::write(&robot)).value;
    let (before, after) = (
        robot.link_poses(&[0.7, 0.1, 0.0]).unwrap(),
        written.link_poses(&[0.7, 0.1, 0.0]).unwrap(),
    );
    assert!((before[2].translation.vector - after[2].translation.vector).norm() < 1e-14);
    let collision = after[1] * written.links[1].collisions[0].pose;
    assert!((collision.translation.vector - before[1].translation.vector).norm() < 1e-14);
}

#[test]
fn what_real_files_contain_is_corrected_with_its_line() {
    let joint = |inside: &str| {
        format!(
            "<joint name='j' type='revolute'>\n<parent link='a'/><child link='b'/>\n{inside}</joint>"
        )
    };
    assert_eq!(
        warnings(&joint("<axis xyz='0 0 1'/>\n<axis xyz='1 0 0'/>")),
        ["line 5, <axis>: there is one before it, which counts"]
    );
    assert_eq!(
        warnings(&joint("<limit lower='$(optenv X 1)'/>")),
        ["line 4, <limit>: lower has '$(optenv', which is no number"]
    );
    assert_eq!(
        warnings(&joint("<origin xyz='1 2 3 4'/>")),
        ["line 4, <origin>: xyz has 4 numbers instead of 3"]
    );
    assert_eq!(
        warnings(&joint("<origin xyz='[0.07, 0, -0.69]'/>")),
        ["line 4, <origin>: xyz has more than spaces between its numbers"]
    );
    assert_eq!(
        warnings(&joint("robot")),
        ["line 2, <joint>: the text 'robot' has no meaning here"]
    );
    assert_eq!(
        warnings(&joint("<axis xyz='0 0 0'/>")),
        ["line 4, <axis>: has no direction; x is taken"]
    );
    let limit = read(&format!(
        "<robot name='r'><link name='a'/><link name='b'/>{}</robot>",
        joint("<limit effort='1'/>")
    ));
    assert_eq!(
        (
            limit.value.joints[0].limits.effort,
            limit.value.joints[0].limits.velocity
        ),
        (Some(1.0), None)
    );
}

#[test]
fn geometry_that_is_not_known_is_left_out() {
    let link = "<link name='c'><collision><geometry>\n<cdf filename='x'/></geometry></collision><visual/></link>";
    assert_eq!(
        warnings(link),
        [
            "line 3, <visual>: has no geometry; it is left out",
            "line 3, <cdf>: the geometry 'cdf' is not known"
        ]
    );
    let parsed = read(
        "<robot name='r'><link name='c'><collision><geometry><plane normal='0 0 1'/></geometry></collision></link><odd/></robot>",
    );
    assert_eq!(
        parsed.value.links[0].collisions[0].geometry,
        Geometry::Plane {
            normal: [0.0, 0.0, 1.0]
        }
    );
    assert_eq!(parsed.warnings[0].kind, WarningKind::NotUnderstood);
}

#[test]
fn a_material_inside_of_a_material_counts() {
    let text = "<robot name='r'><link name='a'><visual><geometry><sphere radius='1'/></geometry><material name='m'><material name='n'><color rgba='1 0 0 1'/></material></material></visual></link></robot>";
    let parsed = read(text);
    assert_eq!(
        parsed.value.links[0].visuals[0]
            .material
            .as_ref()
            .and_then(|material| material.color),
        Some([1.0, 0.0, 0.0, 1.0])
    );
    assert_eq!(parsed.warnings.len(), 1);
}

#[test]
fn joints_without_links_loops_and_circles_of_mimics_are_reported() {
    let joint = |name: &str, parent: &str, child: &str, mimic: &str| {
        format!(
            "<joint name='{name}' type='revolute'><parent link='{parent}'/><child link='{child}'/>{mimic}</joint>\n"
        )
    };
    assert_eq!(
        warnings(&joint("j", "a", "x", "")),
        ["line 2, <joint>: joint 'j' has no child link 'x'; it is left out"]
    );
    let circle = joint("j", "a", "b", "") + &joint("k", "b", "a", "");
    assert_eq!(
        warnings(&circle),
        ["line 3, <joint>: closes a loop: link 'a' is connected already; the joint moves nothing"]
    );
    let mimics = joint("j", "a", "b", "<mimic joint='k'/>")
        + "<link name='c'/>"
        + &joint("k", "b", "c", "<mimic joint='j'/>");
    assert_eq!(
        warnings(&mimics),
        ["line 2, <joint>: mimics joints without end; it moves by itself"]
    );
    assert_eq!(
        warnings(&joint("j", "a", "b", "<mimic joint='j'/>")).len(),
        1
    );
    let chain: String = (1..6)
        .map(|n| {
            let mimic = if n > 1 {
                format!("<mimic joint='j{}' multiplier='1e90'/>", n - 1)
            } else {
                String::new()
            };
            let parent = if n > 1 {
                format!("l{}", n - 1)
            } else {
                "a".to_owned()
            };
            format!(
                "<link name='l{n}'/>{}",
                joint(&format!("j{n}"), &parent, &format!("l{n}"), &mimic)
            )
        })
        .collect();
    assert_eq!(
        warnings(&chain),
        ["line 6, <joint>: mimics joints by numbers that are too large; it moves by itself"]
    );
}

#[test]
fn what_is_no_robot_is_refused() {
    let error = |bytes: &[u8]| urdf::read(bytes).expect_err("it is no robot");
    assert!(matches!(error(b"hello"), ReadError::Xml(_)));
    assert!(matches!(error(b""), ReadError::Xml(_)));
    assert!(matches!(error(b"\xff\xfe\x00"), ReadError::Xml(_)));
    assert_eq!(
        error(b"\n\n<sdf/>"),
        ReadError::WrongRoot {
            line: 3,
            found: "sdf".into(),
            expected: "robot"
        }
    );
    let bomb = b"<!DOCTYPE r [<!ENTITY a 'aaaa'>\n<!ENTITY b '&a;&a;'>]><robot name='&b;'/>";
    assert_eq!(error(bomb), ReadError::Entities { line: 1 });
    assert!(matches!(
        error(&[b'a'; (64 << 20) + 1]),
        ReadError::TooLong(_)
    ));
    let many = format!("<robot>{}</robot>", "<a/>".repeat(1_000_001));
    assert_eq!(error(many.as_bytes()), ReadError::TooManyNodes);
}

#[test]
fn macros_are_refused_with_the_command_that_expands_them() {
    let declared =
        "<robot xmlns:xacro='http://ros.org/wiki/xacro'>\n<xacro:include filename='x'/></robot>";
    assert_eq!(
        urdf::read(declared.as_bytes()).expect_err("a macro"),
        ReadError::Xacro { line: 2 }
    );
    let error = urdf::read(b"<robot>\n<xacro:include filename='x'/></robot>").expect_err("a macro");
    assert!(error.to_string().contains("xacro FILE > robot.urdf"));
    assert!(
        urdf::read(
            b"<robot><link name='a'><inertial><mass value='${m}'/></inertial></link></robot>"
        )
        .is_err()
    );
    assert!(
        urdf::read(
            b"<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'><link name='a'/></robot>"
        )
        .is_ok()
    );
}

#[test]
fn what_stands_around_the_document_and_bytes_that_are_no_text_do_not_matter() {
    let parsed =
        urdf::read(b"\xef\xbb\xbf\n \n<?xml version='1.0'?>\n<!DOCTYPE robot>\n<robot name='\xff'><link name='a'/>\n<odd/></robot>\r\n\0")
            .expect("a robot");
    assert_eq!(parsed.value.name, "\u{fffd}");
    assert_eq!(parsed.warnings[0].line, 6);
}

#[test]
fn files_cut_anywhere_and_absurd_numbers_do_no_harm() {
    for end in 0..ARM.len() {
        if let Ok(parsed) = urdf::read(&ARM.as_bytes()[..end]) {
            panic!("{end} bytes are no document, but were read: {parsed:?}");
        }
    }
    for number in [
        "1e999",
        "-1e308",
        "nan",
        "inf",
        "1e-320",
        "0x10",
        "",
        " ",
        "1 ".repeat(1000).as_str(),
    ] {
        for attribute in [
            "xyz=\"0 0 1\"",
            "size=\"0.1 0.2 0.3\"",
            "mass value=\"2.5\"",
            "radius=\"0.3\"",
            "lower=\"-1\"",
            "scale=\"1 -1 0.5\"",
        ] {
            let (name, _) = attribute.split_once("=\"").expect("they have one");
            let parsed = read(&ARM.replace(attribute, &format!("{name}=\"{number}\"")));
            let poses = parsed
                .value
                .link_poses(&[1.0, 1.0, 1.0])
                .expect("three joints");
            assert!(
                poses
                    .iter()
                    .all(|pose| pose.translation.vector.iter().all(|x| x.is_finite())),
                "{name} {number}"
            );
            read(&urdf::write(&parsed.value));
        }
    }
}

/// Bytes that are changed here and there: what is read has as many frames as links, and is written so that it is read again.
#[test]
fn changed_files_are_robots_or_errors() {
    let mut random = Random::new(12345);
    let mut below = |bound| random.below(bound);
    let mut read_ones = 0;
    for _ in 0..3000 {
        let mut bytes = ARM.as_bytes().to_vec();
        for _ in 0..1 + below(4) {
            let (at, from, length) = (below(bytes.len()), below(bytes.len()), below(40));
            let piece = bytes[from..(from + length).min(bytes.len())].to_vec();
            match below(3) {
                0 => bytes[at] = below(256) as u8,
                1 => drop(bytes.splice(at..at, piece)),
                _ => drop(bytes.drain(at..(at + length).min(bytes.len()))),
            }
        }
        let Ok(parsed) = urdf::read(&bytes) else {
            continue;
        };
        read_ones += 1;
        let robot = parsed.value;
        assert_eq!(
            robot
                .link_poses(&robot.zero_positions())
                .expect("as many as joints")
                .len(),
            robot.links.len()
        );
        let again = read(&urdf::write(&robot)).value;
        assert_eq!(
            (again.links.len(), again.joints.len()),
            (robot.links.len(), robot.joints.len())
        );
    }
    assert!(read_ones > 100, "{read_ones}");
}

/// The parser of XML compares each attribute of an element with all others, and namespaces with those around them.
#[test]
fn elements_with_very_many_attributes_or_namespaces_are_refused() {
    let attributes = |from: usize, count: usize| -> String {
        (from..from + count)
            .map(|number| format!(" a{number}='a=\"b\">'"))
            .collect()
    };
    let robot = |link: &str| {
        format!(
            "<?xml version='1.0'?><?p a='<'?>\n<!-- <a{0}/> --><robot name='r'>\n<link name='a'{link}/></robot>",
            attributes(0, 300)
        )
    };
    assert!(urdf::read(robot(&attributes(0, 199)).as_bytes()).is_ok());
    for count in [200, 200_000] {
        let error = urdf::read(robot(&attributes(0, count)).as_bytes()).expect_err("too many");
        assert_eq!(error, ReadError::TooManyAttributes { line: 3 });
    }
    let many: String = (0..60_000)
        .map(|n| format!("<link name='l{n}' xmlns:x{n}='x'>"))
        .collect();
    let error = urdf::read(format!("<robot name='r'>{many}").as_bytes()).expect_err("too many");
    assert_eq!(error, ReadError::TooManyNamespaces);
}

#[test]
fn warnings_are_bounded() {
    let parsed = read(&format!(
        "<robot name='r'><link name='a'/>{}</robot>",
        "<odd/>".repeat(10_000)
    ));
    assert_eq!(
        (parsed.warnings.len(), parsed.further_warnings),
        (500, 9_500)
    );
}

/// Long chains are no recursion, and take time that grows with their length.
#[test]
fn a_chain_of_fifty_thousand_links_is_read() {
    let mut text = String::from("<robot name='r'><link name='l0'/>");
    for i in 1..50_000 {
        text += &format!(
            "<link name='l{i}'/><joint name='j{i}' type='continuous'><parent link='l{}'/><child link='l{i}'/></joint>",
            i - 1
        );
    }
    let robot = read(&(text + "</robot>")).value;
    assert_eq!(
        robot
            .link_poses(&robot.zero_positions())
            .expect("as many as joints")
            .len(),
        50_000
    );
}
