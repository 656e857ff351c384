//! The state hash: each observable thing counts, undoing a change gives the old hash, and following gives what looking anew gives.

use std::collections::BTreeMap;

use test_support::random::Random;

use crate::{Options, ScriptKind, Simulator};

/// Objects of every kind that scripts can make, and what the statements below need.
const SCENE: &str = r"
sim = require 'sim'
box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
sim.setObjectAlias(box, 'box')
ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1})
sim.setObjectAlias(ball, 'ball')
sim.setObjectPosition(ball, {1, 0, 1})
joint = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
slider = sim.createJoint(sim.joint_prismatic, sim.jointmode_dynamic, 0)
ball_joint = sim.createJoint(sim.joint_spherical, sim.jointmode_kinematic, 0)
dummy = sim.createDummy(0.01)
partner = sim.createDummy(0.01)
sim.setReferencedHandles(box, {dummy})
eye = sim.createVisionSensor(2, {4, 4, 0, 0}, {0.01, 1, 1, 0.1, 0, 0, 0, 0, 0, 0, 0})
ray = sim.createProximitySensor(sim.proximitysensor_ray_subtype, 16, 0, {3, 3, 2, 2, 1, 1, 0, 0}, {0, 0.5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})
force = sim.createForceSensor(0, {0, 1, 1, 0, 0}, {0.01, 100, 10, 0, 0})
cloud = sim.createPointCloud(0.02, 20, 0, 2)
sim.insertPointsIntoPointCloud(cloud, 0, {0, 0, 0, 0.1, 0, 0})
tree = sim.createOctree(0.1, 0, 1)
sim.setStringProperty(sim.handle_scene, 'customData.kept', 'here')
";

/// Each changes one thing that scripts can observe, and undoes that.
const CHANGES: &[[&str; 2]] = &[
    [
        "sim.setObjectPosition(box, {1, 2, 3})",
        "sim.setObjectPosition(box, {0, 0, 0})",
    ],
    [
        "sim.setObjectAlias(box, 'other')",
        "sim.setObjectAlias(box, 'box')",
    ],
    [
        "sim.setObjectParent(box, dummy, true)",
        "sim.setObjectParent(box, -1, true)",
    ],
    [
        "sim.setJointPosition(joint, 0.5)",
        "sim.setJointPosition(joint, 0)",
    ],
    [
        "sim.setObjectQuaternion(dummy, {0, 0, 1, 0})",
        "sim.setObjectQuaternion(dummy, {0, 0, 0, 1})",
    ],
    [
        "sim.setJointTargetVelocity(slider, 2)",
        "sim.setJointTargetVelocity(slider, 0)",
    ],
    [
        "sim.setJointTargetPosition(slider, 0.1)",
        "sim.setJointTargetPosition(slider, 0)",
    ],
    [
        "sim.setJointTargetForce(slider, 7)",
        "sim.setJointTargetForce(slider, 50)",
    ],
    [
        "sim.setObjectInt32Param(slider, sim.jointintparam_dynctrlmode, 8)",
        "sim.setObjectInt32Param(slider, sim.jointintparam_dynctrlmode, mode)",
    ],
    [
        "sim.setJointInterval(joint, false, {-1, 2})",
        "sim.setJointInterval(joint, true, {-math.pi, 2 * math.pi})",
    ],
    [
        "sim.setJointDependency(joint, slider, 0, 2)",
        "sim.setJointDependency(joint, -1, 0, 1)",
    ],
    [
        "sim.setBoolProperty(box, 'respondable', true)",
        "sim.setBoolProperty(box, 'respondable', false)",
    ],
    [
        "sim.setIntProperty(box, 'layer', 4)",
        "sim.setIntProperty(box, 'layer', 1)",
    ],
    [
        "sim.setBoolProperty(box, 'collidable', false)",
        "sim.setBoolProperty(box, 'collidable', true)",
    ],
    [
        "sim.setFloatProperty(box, 'bullet.friction', 0.3)",
        "sim.setFloatProperty(box, 'bullet.friction', friction)",
    ],
    [
        "sim.setReferencedHandles(box, {ball, dummy})",
        "sim.setReferencedHandles(box, {dummy})",
    ],
    [
        "sim.setStringProperty(box, 'customData.x', 'y')",
        "sim.removeProperty(box, 'customData.x')",
    ],
    [
        "sim.writeCustomDataBlock(box, 'raw', 'abc')",
        "sim.writeCustomDataBlock(box, 'raw', '')",
    ],
    [
        "sim.setIntProperty(ball, 'signal.s', 3)",
        "sim.removeProperty(ball, 'signal.s')",
    ],
    [
        "sim.setInt32Signal('global', 3)",
        "sim.clearInt32Signal('global')",
    ],
    [
        "sim.setStringProperty(sim.handle_scene, 'customData.kept', 'there')",
        "sim.setStringProperty(sim.handle_scene, 'customData.kept', 'here')",
    ],
    [
        "sim.setNamedStringParam('p', 'v')",
        "sim.removeProperty(sim.handle_app, 'namedParam.p')",
    ],
    [
        "sim.setObjectSelection({box})",
        "sim.setObjectSelection({})",
    ],
    [
        "sim.setFloatProperty(sim.handle_scene, 'timeToPause', 7)",
        "sim.setFloatProperty(sim.handle_scene, 'timeToPause', pause)",
    ],
    [
        "sim.setArrayParam(sim.arrayparam_gravity, {0, 0, -1})",
        "sim.setArrayParam(sim.arrayparam_gravity, {0, 0, -9.81})",
    ],
    [
        "sim.setLinkDummy(dummy, partner)",
        "sim.setLinkDummy(dummy, -1)",
    ],
    [
        "sim.setShapeColor(box, nil, sim.colorcomponent_ambient_diffuse, {1, 0, 0})",
        "sim.setShapeColor(box, nil, sim.colorcomponent_ambient_diffuse, colour)",
    ],
    ["added = sim.createDummy(0.3)", "sim.removeObjects({added})"],
    [
        "sim.setVisionSensorImg(eye, string.rep('a', 48))",
        "sim.setVisionSensorImg(eye, string.rep('b', 48))",
    ],
];

struct Case(Simulator);

impl Case {
    fn new() -> Self {
        let mut case = Self(Simulator::new(Options::default()));
        case.run(SCENE);
        case.run(
            "friction = sim.getFloatProperty(box, 'bullet.friction')
             pause = sim.getFloatProperty(sim.handle_scene, 'timeToPause')
             _, colour = sim.getShapeColor(box, nil, sim.colorcomponent_ambient_diffuse)
             mode = sim.getObjectInt32Param(slider, sim.jointintparam_dynctrlmode)
             sim.setVisionSensorImg(eye, string.rep('b', 48))
             sim.setObjectParent(box, dummy, true) sim.setObjectParent(box, -1, true)",
        );
        case
    }

    fn run(&mut self, code: &str) {
        self.0
            .add_script(ScriptKind::Sandbox, "statement", code.as_bytes())
            .unwrap_or_else(|error| panic!("{code}: {error}"));
    }

    /// The hash, followed and looked at anew.
    fn hash(&self) -> u64 {
        let hash = self.0.state_hash();
        assert_eq!(hash, self.0.parts.sim.state_hash_anew());
        hash
    }
}

#[test]
fn each_change_counts_and_undone_it_does_not() {
    let mut case = Case::new();
    let mut seen = vec![case.hash()];
    let mut wrong = Vec::new();
    for [change, undo] in CHANGES {
        case.run(change);
        let changed = case.hash();
        if seen.contains(&changed) {
            wrong.push(change);
        }
        seen.push(changed);
        case.run(undo);
        if case.hash() != seen[0] {
            wrong.push(undo);
            case = Case::new();
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn random_numbers_time_and_scripts_count() {
    let mut case = Case::new();
    let mut seen = vec![case.hash()];
    for code in [
        "sim.getRandom()",
        "math.random()",
        "local drawn = math.random math.random = nil collectgarbage() drawn()",
        "sim.getFloatProperty(sim.handle_app, 'randomFloat')",
        "sim.setStringProperty(sim.handle_app, 'signal.x', 'y')",
    ] {
        case.run(code);
        let hash = case.hash();
        assert!(!seen.contains(&hash), "{code}");
        seen.push(hash);
    }
    case.0.step(1);
    assert!(!seen.contains(&case.hash()));
    case.0.stop();
    case.run("x = 1");
    let before = case.hash();
    case.run("x = 2");
    assert_eq!(case.hash(), before, "variables are not observed");
}

#[test]
fn a_change_is_told_by_owner_and_name() {
    let mut case = Case::new();
    let mut all = BTreeMap::new();
    case.0.state_hash_with(|value| {
        all.insert((value.target, value.name.to_owned()), value.hash);
    });
    case.run("sim.setJointPosition(joint, 0.5) sim.setInt32Signal('x', 1) handle = joint");
    let mut changed = Vec::new();
    case.0
        .state_hash_with(|value| changed.push((value.target, value.name.to_owned())));
    let joint = case
        .0
        .scene()
        .objects()
        .nth(2)
        .expect("it was made")
        .handle();
    assert_eq!(changed[0], (joint.raw(), "jointPosition".to_owned()));
    assert_eq!(changed.len(), 2, "{changed:?}");
    assert!(changed[1].1.starts_with("signal."), "{changed:?}");
    assert!(all.contains_key(&changed[0]));
}

/// Of a change that the journal did not record, or recorded as something else, the followed hash would know nothing.
#[test]
fn following_equals_looking_anew() {
    let mut case = Case::new();
    let mut random = Random::new(7);
    let undone = CHANGES.iter().flatten().copied();
    let statements: Vec<&str> = undone.chain(STATEMENTS.iter().copied()).collect();
    case.hash();
    for round in 0..120 {
        for _ in 0..=random.below(4) {
            let code = statements[random.below(statements.len())];
            // Some fail after others, such as a removal of what is gone.
            let _ = case
                .0
                .add_script(ScriptKind::Sandbox, "statement", code.as_bytes());
        }
        if round % 3 == 0 {
            case.0.step(1);
        }
        case.hash();
    }
}

/// Further changes, which cannot be undone.
const STATEMENTS: &[&str] = &[
    "sim.setObjectPosition(ball, {math.random(), 0, 1})",
    "copies = sim.copyPasteObjects({box, dummy}, 0)",
    "sim.removeObjects(copies)",
    "sim.removeObjects({partner}) partner = sim.createDummy(0.01)",
    "sim.setBoolProperty(ball, 'dynamic', true)",
    "sim.setJointMode(joint, sim.jointmode_dynamic)",
    "sim.setJointMode(joint, sim.jointmode_kinematic)",
    "sim.setObjectParent(ball, joint, true)",
    "sim.setObjectParent(joint, box, false)",
    "sim.setObjectParent(joint, -1, true)",
    "sim.scaleObjects({box}, 1.1, false)",
    "sim.setReferencedHandles(dummy, {partner})",
    "sim.setJointDependency(joint, slider, 0.1, 0.5)",
    "sim.handleProximitySensor(ray)",
    "sim.handleVisionSensor(eye)",
    "sim.insertPointsIntoPointCloud(cloud, 0, {math.random(), 0, 0})",
    "sim.insertVoxelsIntoOctree(tree, 0, {math.random(), 0, 0}, nil, nil)",
    "sim.stopSimulation()",
    "sim.groupShapes(sim.copyPasteObjects({box, ball}, 0))",
    "sim.writeCustomDataBlock(ball, '', '')",
    "sim.setObjectSpecialProperty(box, 0)",
    "sim.setModelProperty(box, 0)",
];

/// The same scene, made and run twice, has the same hashes, and others with another seed.
#[test]
fn the_same_runs_have_the_same_hashes() {
    let hashes = |seed| {
        let mut case = Case(Simulator::new(Options {
            seed,
            ..Options::default()
        }));
        case.run(SCENE);
        case.run("sim.setBoolProperty(ball, 'dynamic', true)");
        let step = |_| {
            case.0.step(1);
            case.0.state_hash()
        };
        (0..10).map(step).collect::<Vec<_>>()
    };
    assert_eq!(hashes(1), hashes(1));
    assert_ne!(hashes(1), hashes(2));
}
