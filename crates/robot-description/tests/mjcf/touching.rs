//! Which bodies may touch.

use super::*;

#[test]
fn what_no_body_that_moves_may_touch_is_not_touched() {
    let text = |cart: &str| {
        format!(
            r#"<mujoco><worldbody><geom name="rail" size="1" contype="0"/><geom name="floor" size="2" conaffinity="6" contype="0" friction="0.3"/>
            <body><joint/><geom size="1" {cart} friction="0.8"/></body></worldbody></mujoco>"#
        )
    };
    let touched = |cart: &str| {
        let robot = read(&text(cart)).value.robot;
        let names = |link: usize| {
            let collisions = robot.links[link].collisions.iter();
            collisions.map(|part| part.name.clone()).collect::<Vec<_>>()
        };
        (names(0), names(1).len(), robot.links[1].friction)
    };
    assert_eq!(touched(r#"contype="0""#), (vec![], 1, Some(0.8)));
    let floor = vec!["floor".to_owned()];
    assert_eq!(touched(r#"contype="2""#), (floor, 1, Some(0.8)));
    let rail = vec!["rail".to_owned()];
    assert_eq!(touched(""), (rail, 1, Some(0.8)));
}

/// The names of the pairs of bodies that may touch.
fn touching(text: &str) -> Vec<String> {
    let model = read(text).value;
    let name = |link: usize| model.robot.links[link].name.as_str();
    let pairs = model.touching.as_ref().expect("few bodies");
    pairs
        .iter()
        .map(|[a, b]| format!("{} {}", name(*a), name(*b)))
        .collect()
}

const SNAKE: &str = "<body name='a'><joint/><joint axis='1 0 0'/><geom name='ga' size='1'/>
    <body name='b'><joint/><geom name='gb' size='1'/><body name='tip'><geom size='1'/></body>
    <body name='c'><joint/><geom name='gc' size='1'/></body></body></body>";

#[test]
fn bodies_touch_but_for_neighbours_and_what_is_fixed_to_them() {
    let text = world(&format!("<geom type='plane'/>{SNAKE}"));
    let expected = ["world a", "world b", "world tip", "world c", "a c"];
    assert_eq!(touching(&text), expected);
    let unfiltered = text.replace(
        "<worldbody>",
        "<option><flag filterparent='disable'/></option><worldbody>",
    );
    let more = ["a b", "a tip", "a c", "b c", "tip c"];
    assert_eq!(touching(&unfiltered)[4..], more);
}

#[test]
fn pairs_are_what_bits_and_contacts_say() {
    let said = |contact: &str, bits: &str| {
        let text = world(SNAKE).replace("name='gc'", &format!("name='gc' {bits}"));
        touching(&text.replace(
            "</worldbody>",
            &format!("</worldbody><contact>{contact}</contact>"),
        ))
    };
    assert_eq!(said("", ""), ["a c"]);
    assert_eq!(said("<exclude body1='c' body2='a'/>", ""), [""; 0]);
    // The first of one with the second of the other, either way.
    assert_eq!(said("", "contype='2' conaffinity='0'"), [""; 0]);
    assert_eq!(said("", "contype='2' conaffinity='1'"), ["a c"]);
    // A pair touches whatever else is said, neighbours and geoms without bits too.
    let pair = "<pair geom1='gb' geom2='gc'/>";
    assert_eq!(said(pair, "contype='0' conaffinity='0'"), ["b c"]);
    assert_eq!(said(pair, ""), ["a c", "b c"]);
}

#[test]
fn wrong_pairs_are_said() {
    let text = world(SNAKE).replace(
        "</worldbody>",
        "</worldbody>\n<contact><exclude body1='a'/><pair geom1='ga' geom2='x'/><odd/></contact>",
    );
    let expected = [
        "line 4, <odd>: <odd> is not read",
        "line 4, <exclude>: there is no body ''",
        "line 4, <pair>: there is no geom that is touched 'x'",
    ];
    assert_eq!(messages(&read(&text)), expected);
}

#[test]
fn margins_keep_others_away() {
    let text = world(
        "<geom type='plane' margin='.5'/><body><freejoint/><geom size='1' margin='.1'/><geom type='box' size='1 2 3' margin='.1'/>
        <geom type='capsule' size='1 2' margin='.1'/><geom type='cylinder' size='1 2' margin='.1'/><geom type='ellipsoid' size='1 2 3' margin='.1'/></body>",
    );
    let robot = read(&text).value.robot;
    let plane = &robot.links[0].collisions[0];
    assert_eq!(plane.pose.translation.vector, Vector3::new(0.0, 0.0, 0.5));
    let found: Vec<&Geometry> = robot.links[1]
        .collisions
        .iter()
        .map(|part| &part.geometry)
        .collect();
    let expected = [
        Geometry::Sphere { radius: 1.1 },
        Geometry::Box {
            size: [2.2, 4.2, 6.2],
        },
        Geometry::Capsule {
            radius: 1.1,
            length: 4.0,
        },
        Geometry::Cylinder {
            radius: 1.1,
            length: 4.2,
        },
        Geometry::Ellipsoid {
            radii: [1.1, 2.1, 3.1],
        },
    ];
    assert_eq!(found, expected.iter().collect::<Vec<_>>());
    // What is seen, and what weighs, is as it was.
    assert_eq!(
        robot.links[1].visuals[0].geometry,
        Geometry::Sphere { radius: 1.0 }
    );
}

#[test]
fn planes_are_touched_where_they_are_nearest() {
    let robot = read(&world(
        "<geom type='plane' pos='98 1 2' margin='.5' euler='90 0 0'/>",
    ));
    let plane = &robot.value.robot.links[0].collisions[0].pose;
    // It is upright: its normal is -y.
    let expected = Vector3::new(0.0, 0.5, 0.0);
    assert!(
        (plane.translation.vector - expected).norm() < 1e-12,
        "{plane}"
    );
}

#[test]
fn pairs_have_their_own_friction() {
    let text = r#"<mujoco><default><pair friction="0.7"/></default><worldbody><geom name="floor" type="plane" size="1 1 1"/>
        <body name="a"><freejoint/><geom name="a" size="1"/></body><body name="b"><freejoint/><geom name="b" size="1"/></body></worldbody>
        <contact><pair geom1="b" geom2="a" friction="0.25 1"/><pair geom1="floor" geom2="a"/><pair geom1="floor" geom2="b" condim="1"/><pair geom1="floor" geom2="c"/></contact></mujoco>"#;
    let model = read(text).value;
    let expected = [([1, 2], 0.25), ([0, 1], 0.7), ([0, 2], 0.0)];
    assert_eq!(model.pair_frictions, expected);
}
