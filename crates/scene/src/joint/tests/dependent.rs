//! Joints that follow another one (spec: joints 5).

use super::*;

/// q = offset + coefficient * q of the master, along the chain, and the velocity likewise without the offset.
#[test]
fn dependent_joints_follow_with_offset_and_coefficient() {
    let mut scene = Scene::new();
    let [master, second, third] = [(); 3].map(|()| {
        added(
            &mut scene,
            joint(JointType::Prismatic, JointMode::Dependent),
        )
    });
    scene
        .set_joint_dependency(second, Some(master), 0.1, 2.0)
        .unwrap();
    scene
        .set_joint_dependency(third, Some(second), -0.3, -3.0)
        .unwrap();
    scene
        .modify_joint(master, |joint| joint.velocity = 0.5)
        .unwrap();
    assert_eq!(
        [master, second, third].map(|handle| scene.joint_velocity(handle)),
        [Ok(0.5), Ok(1.0), Ok(-3.0)]
    );
    scene.set_joint_position(master, 0.4).unwrap();
    let position = |handle| read(&scene, handle).position;
    assert!((position(second) - 0.9).abs() < 1e-12 && (position(third) + 3.0).abs() < 1e-12);
    // Its own interval does not count.
    scene.set_joint_interval(third, false, [-0.5, 1.0]).unwrap();
    assert!((read(&scene, third).position + 3.0).abs() < 1e-12);
    // In another mode it does not follow, and forgets its master.
    scene.set_joint_mode(second, JointMode::Kinematic).unwrap();
    assert_eq!(
        (
            read(&scene, second).position,
            read(&scene, second).dependency
        ),
        (0.5, None)
    );
    scene.set_joint_position(master, 0.0).unwrap();
    assert_eq!(read(&scene, second).position, 0.5);
    scene.set_joint_dependency(third, None, 0.0, 1.0).unwrap();
    assert_eq!(read(&scene, third).dependency, None);
}

#[test]
fn dependencies_that_cannot_be_are_ignored_or_limited() {
    let mut scene = Scene::new();
    let [one, two] = [(); 2].map(|()| {
        added(
            &mut scene,
            joint(JointType::Prismatic, JointMode::Dependent),
        )
    });
    let ball = added(&mut scene, kinematic(JointType::Spherical));
    for (handle, master) in [(one, one), (one, ball), (ball, one)] {
        scene
            .set_joint_dependency(handle, Some(master), 0.0, 1.0)
            .unwrap();
        assert_eq!(read(&scene, handle).dependency, None);
    }
    scene
        .set_joint_dependency(one, Some(two), -1e9, 1e9)
        .unwrap();
    let law = read(&scene, one).dependency.unwrap();
    assert_eq!((law.master, law.offset, law.coefficient), (two, -1e4, 1e4));
    scene
        .set_joint_dependency(one, Some(two), f64::NAN, f64::NAN)
        .unwrap();
    let law = read(&scene, one).dependency.unwrap();
    assert_eq!((law.offset, law.coefficient), (0.0, 0.0));
}
