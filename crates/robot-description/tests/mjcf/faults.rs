//! Included files, limits, and what is wrong in files.

use super::*;

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
    let parsed = read(&text.replace("</mujoco>", "\n<sensor/><visual/></mujoco>"));
    let expected = [
        "line 9, <sensor>: <sensor> is not read",
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
