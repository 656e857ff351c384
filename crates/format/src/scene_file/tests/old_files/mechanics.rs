//! Joints, force sensors and dummies.

use super::{object, objects, one};
use crate::ttt::EngineBlock;
use crate::ttt::chunks::{Dummy, ForceSensor, Joint as Chunk};
use crate::ttt::tree::Class;
use scene::joint::{Control, Joint, JointDependency, JointMode, JointType};
use scene::object::dummy::LinkType;
use scene::sensor::force_sensor::ForceFilter;

fn joint(chunk: Chunk) -> Joint {
    one(Class::Joint(Box::new(chunk))).joint().unwrap().clone()
}

fn revolute() -> Chunk {
    Chunk {
        joint_type: Some(10),
        joint_mode: Some(5),
        ..Chunk::default()
    }
}

#[test]
fn a_joint_of_which_nothing_is_said() {
    use std::f64::consts::TAU;
    let joint = joint(Chunk::default());
    assert_eq!(
        (joint.joint_type, joint.mode),
        (JointType::Revolute, JointMode::Kinematic)
    );
    assert_eq!(
        (joint.position, joint.target_position, joint.screw_lead),
        (0.0, 0.0, 0.0)
    );
    assert_eq!((joint.target_velocity, joint.target_force), (0.0, 1000.0));
    assert_eq!([joint.max_vel, joint.max_accel, joint.max_jerk], [TAU; 3]);
    assert_eq!(
        (joint.control, joint.gains[0]),
        (Control::Free, [0.1, 0.0, 0.0])
    );
    assert!(!joint.cyclic && !joint.hybrid && !joint.motor_lock && !joint.enforce_limits);
    assert!(!joint.position_profile && !joint.velocity_profile);
}

#[test]
fn control_before_4_3_is_in_the_switches() {
    for (switches, control) in [
        (0x00, Control::Free),
        (0x20, Control::Free),
        (0xa0, Control::Free),
        (0x10, Control::Velocity),
        (0x30, Control::PositionOrCallback),
        (0x90, Control::SpringOrCallback),
    ] {
        let chunk = Chunk {
            switches: Some(switches),
            ..revolute()
        };
        assert_eq!(joint(chunk.clone()).control, control, "{switches:#x}");
        let new = Chunk {
            dyn_ctrl_mode: Some(1),
            ..chunk
        };
        assert_eq!(joint(new).control, Control::Force);
    }
}

#[test]
fn switches_of_joints() {
    let with = |switches, second| Chunk {
        switches: Some(switches),
        switches_2: Some(second),
        ..revolute()
    };
    let flags = |chunk| {
        let joint = joint(chunk);
        [
            joint.cyclic,
            joint.hybrid,
            joint.motor_lock,
            joint.enforce_limits,
        ]
    };
    assert_eq!(flags(with(0x1, 0x2)), [true, false, true, false]);
    assert_eq!(flags(with(0x40, 0x4)), [false, true, false, true]);
    assert_eq!(flags(with(0xbe, 0xf9)), [false; 4]);
}

#[test]
fn profiles_are_for_one_control_or_for_both() {
    let profiles = |position, velocity, both| {
        let joint = joint(Chunk {
            pos_ctrl_profile: position,
            vel_ctrl_profile: velocity,
            switches_3: both,
            ..revolute()
        });
        (joint.position_profile, joint.velocity_profile)
    };
    assert_eq!(profiles(Some(1), None, None), (true, false));
    assert_eq!(profiles(Some(0), Some(1), Some(0)), (false, true));
    assert_eq!(profiles(None, None, Some(1)), (true, true));
    assert_eq!(profiles(Some(0), Some(0), Some(2)), (false, false));
}

#[test]
fn velocity_and_force_push_the_same_way() {
    for (velocity, force, expected) in [
        (2.0, 3.0, 3.0),
        (-2.0, 3.0, -3.0),
        (2.0, -3.0, 3.0),
        (-2.0, -3.0, -3.0),
        (0.0, -3.0, -3.0),
    ] {
        let chunk = Chunk {
            motor: Some([velocity, force]),
            ..revolute()
        };
        assert_eq!(joint(chunk).target_force, expected);
    }
}

#[test]
fn a_limit_of_velocity_before_4_3_counts_where_the_physics_moves() {
    let limited = |mode, switches, limit| {
        joint(Chunk {
            joint_mode: Some(mode),
            switches: Some(switches),
            upper_velocity_limit: Some(limit),
            max_vel_accel_jerk: Some([1.0, 2.0, 3.0]),
            ..revolute()
        })
        .max_vel
    };
    assert_eq!(
        [
            limited(5, 0, 0.5),
            limited(0, 0x40, 0.5),
            limited(0, 0, 0.5)
        ],
        [0.5, 0.5, 1.0]
    );
    assert_eq!([limited(5, 0, 0.0), limited(5, 0, -1.0)], [1.0; 2]);
}

#[test]
fn a_screw_pitch_is_a_lead_per_radian() {
    let lead = |kind, pitch, lead| {
        joint(Chunk {
            joint_type: Some(kind),
            screw_pitch: pitch,
            screw_lead: lead,
            ..revolute()
        })
        .screw_lead
    };
    assert!((lead(10, Some(0.5), None) - std::f64::consts::PI).abs() < 1e-12);
    assert_eq!(lead(10, Some(0.5), Some(0.25)), 0.25);
    assert_eq!(
        [
            lead(11, None, Some(0.25)),
            lead(10, None, Some(f64::INFINITY))
        ],
        [0.0; 2]
    );
}

#[test]
fn numbers_that_are_not_finite_leave_the_default() {
    let nan = f64::NAN;
    let chunk = Chunk {
        limits: Some([nan, 1.0]),
        position: Some(nan),
        target_pos: Some(nan),
        sizes: Some([1.0, nan]),
        ik_weight: Some(nan),
        ik_max_step: Some(nan),
        ..revolute()
    };
    let default = Joint::new(JointType::Revolute, JointMode::Dynamic);
    let joint = joint(chunk);
    assert_eq!(
        (joint.min, joint.range, joint.size),
        (default.min, default.range, default.size)
    );
    assert_eq!(
        (joint.position, joint.target_position, joint.ik),
        (0.0, 0.0, default.ik)
    );
}

#[test]
fn gains_were_the_same_for_all_engines_and_once_per_step() {
    let [old, oldest] = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
    let gains = |old_pid, oldest_pid| {
        joint(Chunk {
            oldest_pid,
            old_pid,
            ..revolute()
        })
        .gains
    };
    assert_eq!(gains(Some(old), Some(oldest)), [[1.0, 2.0, 3.0]; 5]);
    // Divided by the step of 5 ms.
    assert_eq!(gains(None, Some(oldest)), [[4.0, 1000.0, 1200.0]; 5]);
}

#[test]
fn a_spring_was_a_share_of_the_greatest_force() {
    let with = |kind, pid, switches| {
        joint(Chunk {
            joint_type: Some(kind),
            motor: Some([0.0, 10.0]),
            old_pid: pid,
            switches: Some(switches),
            ..revolute()
        })
    };
    let soft = with(11, Some([0.5, 0.25, 0.125]), 0xb0);
    assert_eq!((soft.spring, soft.target_force), ([5.0, 1.25], 10.0));
    assert_eq!(soft.gains[0], [0.5, 0.25, 0.125]);
    // More than the whole force at one metre: the force grows, and the gains become shares of it.
    let hard = with(11, Some([4.0, 2.0, -1.0]), 0xb0);
    assert_eq!((hard.spring, hard.target_force), ([40.0, -10.0], 40.0));
    assert_eq!(hard.gains[4], [1.0, 0.5, -0.25]);
    let damped = with(11, Some([0.5, 0.0, -2.0]), 0xb0);
    assert_eq!((damped.spring, damped.target_force), ([5.0, -20.0], 20.0));
    // The same at a whole turn.
    let turning = with(10, Some([1.0, 0.0, 0.5]), 0xb0);
    assert!((turning.target_force - 20.0 * std::f64::consts::PI).abs() < 1e-9);
    let whole = with(11, Some([1.0, 0.0, 0.0]), 0xb0);
    assert_eq!(
        (whole.target_force, whole.gains[0]),
        (10.0, [1.0, 0.0, 0.0])
    );
    assert_eq!(with(11, None, 0xb0).spring, [1.0, 0.0]);
    let default = Joint::new(JointType::Prismatic, JointMode::Dynamic).spring;
    assert_eq!(with(11, Some([0.5, 0.0, 0.0]), 0x30).spring, default);
}

/// A joint with the parameters of an engine in which another one is named as its master.
fn bound(vortex: bool, newton: bool, mujoco: bool) -> Option<JointDependency> {
    let mut chunk = revolute();
    // Numbers of the master, factor and offset (spec: scene-files 8).
    let mut reals = vec![0.0; 54];
    (reals[47], reals[48]) = (2.0, 3.0);
    if vortex {
        chunk.vortex = Some(EngineBlock {
            reals,
            ints: vec![0, 0, 0, 0, -1, 1],
        });
    }
    if newton {
        chunk.newton = Some(EngineBlock {
            reals: vec![4.0, 5.0],
            ints: vec![-1, 1],
        });
    }
    if mujoco {
        let mut reals = vec![0.0; 30];
        (reals[22], reals[23]) = (6.0, 7.0);
        chunk.mujoco = Some(EngineBlock {
            reals,
            ints: vec![-1, 1],
        });
    }
    let master = object(1, -1, Class::Joint(Box::new(revolute())));
    let follower = object(2, -1, Class::Joint(Box::new(chunk)));
    let (scene, handles) = objects(40_100, 22, vec![master, follower]);
    scene
        .object(handles[1])
        .unwrap()
        .joint()
        .unwrap()
        .dependency
}

#[test]
fn masters_were_parameters_of_the_engines() {
    let law = |[vortex, newton, mujoco]: [bool; 3]| {
        bound(vortex, newton, mujoco).map(|law| (law.coefficient, law.offset))
    };
    assert_eq!(law([false; 3]), None);
    assert_eq!(law([true, false, false]), Some((2.0, 3.0)));
    assert_eq!(law([false, true, false]), Some((4.0, 5.0)));
    assert_eq!(law([false, false, true]), Some((7.0, 6.0)));
    // The first of MuJoCo, Vortex and Newton that names a joint counts.
    assert_eq!(
        (law([true; 3]), law([true, true, false])),
        (law([false, false, true]), law([true, false, false]))
    );
}

#[test]
fn a_joint_follows_another_one_only() {
    let follows = |master: i32, mode: i32| {
        let chunk = Chunk {
            joint_mode: Some(mode),
            dependency: Some((master, [2.0, 0.5])),
            ..revolute()
        };
        let others = [
            object(1, -1, Class::Joint(Box::new(revolute()))),
            object(2, -1, Class::Joint(Box::new(chunk))),
            object(3, -1, Class::Dummy(Box::default())),
        ];
        let (scene, handles) = objects(41_000, 25, others.into());
        let joint = scene.object(handles[1]).unwrap().joint().unwrap();
        let dependency = joint.dependency;
        (
            dependency.map(|law| (law.master == handles[0], law.coefficient, law.offset)),
            joint.mode,
        )
    };
    let law = Some((true, 2.0, 0.5));
    assert_eq!(follows(1, 4), (law, JointMode::Dependent));
    assert_eq!(follows(1, 0), (law, JointMode::Dependent));
    assert_eq!(follows(1, 5), (law, JointMode::Dynamic));
    for nobody in [2, 3, 9, -1] {
        assert_eq!(follows(nobody, 0), (None, JointMode::Kinematic), "{nobody}");
    }
}

#[test]
fn force_sensors() {
    let sensor = |chunk: ForceSensor| {
        let object = one(Class::ForceSensor(Box::new(chunk)));
        let scene::Kind::ForceSensor(sensor) = object.kind else {
            panic!("no force sensor")
        };
        *sensor
    };
    let old = sensor(ForceSensor {
        old_thresholds: Some(([1.5, 2.5], 0)),
        switches: Some(2),
        filter: Some([-3, 0]),
        ..ForceSensor::default()
    });
    assert_eq!((old.force_threshold, old.torque_threshold), (1.5, 2.5));
    assert_eq!((old.consecutive_violations, old.sample_size), (1, 1));
    assert_eq!(
        (old.force_threshold_enabled, old.torque_threshold_enabled),
        (false, true)
    );
    assert_eq!(old.filter, ForceFilter::Average);
    let new = sensor(ForceSensor {
        old_thresholds: Some(([1.5, 2.5], 3)),
        thresholds: Some(([3.5, 4.5], 5)),
        switches: Some(1),
        filter: Some([1_000_000, 1]),
        ..ForceSensor::default()
    });
    assert_eq!((new.force_threshold, new.consecutive_violations), (3.5, 5));
    assert_eq!(
        (new.force_threshold_enabled, new.torque_threshold_enabled),
        (true, false)
    );
    assert_eq!((new.sample_size, new.filter), (10_000, ForceFilter::Median));
}

#[test]
fn dummies_and_their_partners() {
    let with = |link, link_type| Dummy {
        linked_dummy: Some(link),
        link_type: Some(link_type),
        switches: Some(0xff),
        path_off: Some(0.5),
        ..Dummy::default()
    };
    let all = vec![
        object(1, -1, Class::Dummy(Box::new(with(2, 0)))),
        object(2, -1, Class::Dummy(Box::new(with(1, 0)))),
        // One is no dummy, one is gone, one has a type that is gone.
        object(3, -1, Class::Dummy(Box::new(with(6, 9)))),
        object(4, -1, Class::Dummy(Box::new(with(9, 7)))),
        object(5, -1, Class::Dummy(Box::new(with(-1, 5)))),
        object(6, -1, Class::Joint(Box::default())),
    ];
    let (scene, handles) = objects(41_000, 25, all);
    let of = |at: usize| scene.object(handles[at]).unwrap().dummy().unwrap();
    assert_eq!(
        (of(0).link, of(1).link),
        (Some(handles[1]), Some(handles[0]))
    );
    assert_eq!(
        (of(0).link_type, of(1).link_type),
        (LinkType::LoopClosure, LinkType::LoopClosure)
    );
    assert!((2..5).all(|at| of(at).link.is_none()));
    let kinds = [2, 3, 4].map(|at| of(at).link_type);
    assert_eq!(
        kinds,
        [LinkType::Assembly, LinkType::Tendon, LinkType::Default]
    );
    assert_eq!(
        (of(0).path_following.bits, of(0).path_following.offsets),
        (0xe, [0.5; 2])
    );
}
