//! Tendons, and what moves them.

use robot_description::mjcf::{Element, Fragment, Target, Tendon, TendonPart};

use super::*;

const FINGER: &str = r#"<mujoco><default><tendon stiffness="7" damping="2"/></default><worldbody><site name="top" pos="0 0 1"/>
    <body><joint name="a" range="0 90"/><geom size="1"/><site name="tip"/><site name="mid"/>
    <body><joint name="b" type="slide"/><geom size="1"/><body><joint name="round" type="ball"/><geom size="1"/></body></body></body></worldbody>"#;

fn with(rest: &str) -> Parsed<Model> {
    read(&format!("{FINGER}{rest}</mujoco>"))
}

#[test]
fn tendons_lead_over_sites_or_joints() {
    let parsed = with(
        r#"<tendon><fixed name="both" range="-1 2" frictionloss="3" armature=".1" springlength=".5"><joint joint="a" coef=".5"/><joint joint="b" coef="-2"/></fixed>
        <spatial stiffness="100" springlength="1 2" range="0 5" limited="false"><site site="top"/><site site="mid"/><pulley divisor="2"/><site site="top"/><site site="tip"/></spatial>
        <spatial springlength="-1"><site site="top"/><site site="tip"/></spatial></tendon>"#,
    );
    assert_eq!(messages(&parsed), [] as [&str; 0]);
    let [fixed, spatial, last] = parsed.value.tendons.as_slice() else {
        panic!("three tendons")
    };
    let expected = Tendon {
        name: "both".to_owned(),
        path: vec![
            TendonPart::Joint("a".to_owned(), 0.5),
            TendonPart::Joint("b".to_owned(), -2.0),
        ],
        stiffness: 7.0,
        damping: 2.0,
        friction: 3.0,
        armature: 0.1,
        rest: Some([0.5; 2]),
        range: Some([-1.0, 2.0]),
        line: 3,
    };
    assert_eq!(*fixed, expected);
    let site = |name: &str| TendonPart::Site(name.to_owned());
    let path = [
        site("top"),
        site("mid"),
        TendonPart::Pulley(2.0),
        site("top"),
        site("tip"),
    ];
    assert_eq!(spatial.path, path);
    assert_eq!(
        (spatial.stiffness, spatial.rest, spatial.range),
        (100.0, Some([1.0, 2.0]), None)
    );
    assert_eq!((last.name.as_str(), last.rest), ("tendon_2", None));
}

#[test]
fn actuators_move_tendons_by_their_gear_within_their_ranges() {
    let model = with(
        r#"<tendon><fixed name="both" range="1 3"><joint joint="a" coef="1"/></fixed></tendon>
        <actuator><position name="grip" tendon="both" kp="10" kv="1" gear="2" forcerange="-3 4"/><motor joint="b"/><position tendon="both" inheritrange="1"/></actuator>"#,
    )
    .value;
    let [grip, motor, whole] = model.actuators.as_slice() else {
        panic!("three actuators")
    };
    assert_eq!(
        (grip.target, motor.target),
        (Target::Tendon(0), Target::Joint(1))
    );
    let drive = Drive::Position {
        stiffness: 40.0,
        damping: 4.0,
    };
    assert_eq!((grip.drive, grip.range), (drive, Some([-6.0, 8.0])));
    assert_eq!(whole.control, Some([1.0, 3.0]));
}

#[test]
fn what_a_tendon_cannot_be_over_is_named_with_its_line() {
    let parsed = with(
        r#"
        <tendon><fixed><joint joint="c" coef="1"/></fixed>
        <fixed><joint joint="round" coef="1"/></fixed>
        <fixed><joint joint="a"/></fixed>
        <fixed/>
        <spatial><site site="none"/><site site="tip"/></spatial>
        <spatial><site site="tip"/><pulley divisor="1"/><site site="top"/></spatial>
        <spatial><site site="tip"/><site site="top"/><pulley divisor="0"/></spatial>
        <spatial range="2 1"><site site="tip"/><site site="top"/></spatial>
        <spatial name="winds"><site site="tip"/><geom geom="g"/><site site="top"/></spatial>
        <skein/></tendon><actuator><motor tendon="gone"/></actuator>"#,
    );
    assert_eq!(parsed.value.tendons.len(), 1);
    let expected = [
        "line 4, <fixed>: there is no joint 'c'",
        "line 5, <fixed>: the joint 'round' neither turns nor slides",
        "line 6, <fixed>: a joint of it has no coef",
        "line 7, <fixed>: it has no joints",
        "line 8, <spatial>: there is no site 'none'",
        "line 9, <spatial>: it does not lead from a site to another one",
        "line 10, <spatial>: a pulley of it has no positive divisor",
        "line 11, <spatial>: its range, 2 to 1, has no length in it",
        "line 12, <geom>: a tendon does not wind around geoms: it goes straight from site to site",
        "line 13, <skein>: <skein> is not read",
        "line 13, <motor>: there is no tendon 'gone'",
    ];
    assert_eq!(messages(&parsed), expected);
}

fn element(text: &str) -> Element {
    let fragment = Fragment::read(text).expect("XML");
    fragment.elements.into_iter().next().expect("an element")
}

#[test]
fn pieces_of_models_have_tendons_motors_and_adhesion() {
    let spatial = element(r#"<spatial stiffness="3"><site site="x"/><site site="y"/></spatial>"#);
    let (tendon, warnings) = Tendon::of_element(&spatial).expect("a tendon");
    assert_eq!((tendon.stiffness, tendon.path.len()), (3.0, 2));
    assert!(warnings.is_empty() && Tendon::of_element(&element("<fixed/>")).is_err());
    let motor = element(r#"<motor tendon="t" gear="2" ctrlrange="-1 1"/>"#);
    let (motor, moved, _) = mjcf::Actuator::of_element(&motor).expect("a motor");
    assert_eq!(moved, ["tendon", "t"]);
    assert_eq!(motor.range, Some([-2.0, 2.0]));
    assert!(mjcf::Actuator::of_element(&element("<motor/>")).is_err());
    let adhesion = element(r#"<adhesion body="b" gain="4"/>"#);
    let (adhesion, body) = mjcf::Adhesion::of_element(&adhesion).expect("a body");
    assert_eq!((adhesion.gain, body.as_str()), (4.0, "b"));
    assert!(mjcf::Adhesion::of_element(&element("<adhesion/>")).is_err());
}
