//! Motors, what they act on, and what acts on bodies beside them; constraints.

use robot_description::mjcf::Target;

use super::*;

#[test]
fn actuators_and_constraints_name_what_they_act_on() {
    let model = read(ARM).value;
    let drives: Vec<_> = model
        .actuators
        .iter()
        .map(|actuator| (actuator.target, actuator.drive, actuator.effort))
        .collect();
    let expected = [
        (
            Target::Joint(1),
            Drive::Position {
                stiffness: 200.0,
                damping: 0.0,
            },
            Some(40.0),
        ),
        (Target::Joint(2), Drive::Velocity { damping: 7.0 }, None),
        (Target::Joint(2), Drive::Force, Some(3.0)),
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
    let [(belt, motion), ball] = model.moving_surfaces[..] else {
        panic!("{:?}", model.moving_surfaces);
    };
    assert_eq!(ball, (named("ball"), [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
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
