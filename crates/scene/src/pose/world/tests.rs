//! Cached poses equal recomputed ones, bit for bit, after random operations.

use geometry::PrimitiveKind;
use nalgebra::{UnitQuaternion, Vector3};
use test_support::random;

use super::{STRETCH, bits};
use crate::joint::{Joint, JointMode, JointType};
use crate::object::dummy::Dummy;
use crate::pose::measure::measured;
use crate::shape::{Shape, Velocity};
use crate::simulation::dynamics_report::JointReport;
use crate::{CopyOptions, DynamicFlags, Field, Handle, Kind, MeasuredVelocity, Pose, Scene};

/// What is drawn at random.
pub(crate) struct Random(random::Random);

impl Random {
    pub(crate) fn below(&mut self, end: usize) -> usize {
        self.0.below(end)
    }

    fn pose(&mut self) -> Pose {
        let mut vector = || Vector3::from(self.0.vector());
        Pose::new(vector(), vector() * 3.0)
    }

    fn rotation(&mut self) -> UnitQuaternion<f64> {
        self.pose().rotation
    }

    pub(crate) fn of(&mut self, handles: &[Handle]) -> Handle {
        handles[self.below(handles.len())]
    }

    fn kind(&mut self) -> Kind {
        let joint =
            |joint_type| Kind::Joint(Box::new(Joint::new(joint_type, JointMode::Kinematic)));
        match self.below(6) {
            0 => joint(JointType::Revolute),
            1 => joint(JointType::Prismatic),
            2 => joint(JointType::Spherical),
            3 => Kind::ForceSensor(Box::default()),
            4 => Kind::Shape(Box::new(
                Shape::primitive(PrimitiveKind::Cuboid, [0.1, 0.2, 0.3], Default::default())
                    .expect("a cuboid"),
            )),
            _ => Kind::Dummy(Dummy::new(0.01)),
        }
    }
}

/// A scene under random operations; it may refuse some of them.
struct Play {
    scene: Scene,
    random: Random,
}

impl Play {
    fn handles(&self) -> Vec<Handle> {
        self.scene.all_breadth_first()
    }

    fn joints(&self) -> Vec<Handle> {
        self.handles()
            .into_iter()
            .filter(|&h| self.scene.object(h).unwrap().joint().is_ok())
            .collect()
    }

    fn add(&mut self) {
        let kind = self.random.kind();
        let parent = Some(self.handles())
            .filter(|all| !all.is_empty())
            .map(|all| self.random.of(&all));
        let new = self.scene.add("o", kind).unwrap();
        self.scene.set_parent(new, parent, false).unwrap();
        self.scene.set_local_pose(new, self.random.pose()).unwrap();
    }

    /// Changes of the tree and of places.
    fn change_tree(&mut self, all: &[Handle]) {
        let (handle, other, pose) = (self.random.of(all), self.random.of(all), self.random.pose());
        let scene = &mut self.scene;
        match self.random.below(9) {
            0 => drop(scene.set_parent(handle, Some(other), true)),
            1 => drop(scene.set_parent(handle, Some(other), false)),
            2 => drop(scene.set_parent(handle, None, true)),
            3 => scene.set_local_pose(handle, pose).unwrap(),
            4 => scene.set_world_pose(handle, pose).unwrap(),
            5 => drop(scene.set_hierarchy_order(handle, 0)),
            6 => scene
                .scale_objects(
                    &[handle, other][..1 + usize::from(handle != other)],
                    1.1,
                    true,
                )
                .unwrap(),
            7 if all.len() > 30 => scene.remove(&scene.subtree(handle)[..1]).unwrap(),
            7 if all.len() > 20 => scene.remove(&scene.subtree(handle)).unwrap(),
            7 => {
                let originals = scene.subtree(handle);
                scene
                    .copy_objects(&originals, CopyOptions::empty())
                    .unwrap();
            }
            _ => self.add(),
        }
    }

    /// Changes of joints, and of what hangs on them.
    fn change_joint(&mut self, joints: &[Handle]) {
        let (joint, other) = (self.random.of(joints), self.random.of(joints));
        let (value, rotation) = (self.random.0.signed(), self.random.rotation());
        let scene = &mut self.scene;
        match self.random.below(8) {
            0 => drop(scene.set_joint_position(joint, value)),
            1 => drop(scene.set_spherical_rotation(joint, rotation).unwrap()),
            2 => drop(scene.set_joint_interval(joint, value > 0.0, [value, 0.3])),
            3 => scene.set_joint_mode(joint, JointMode::Dependent).unwrap(),
            4 => scene
                .set_joint_dependency(joint, Some(other), value, 2.0 * value)
                .unwrap(),
            5 => scene
                .modify_joint(joint, |joint| joint.set_screw_lead(value))
                .unwrap(),
            6 => scene.move_joint(joint, value).unwrap(),
            _ => scene
                .set_kind_float_param(joint, 2013, value)
                .map(drop)
                .unwrap(),
        }
    }

    /// Poses written by the physics, and starts and ends of runs.
    fn simulate(&mut self, all: &[Handle]) {
        let (handle, pose) = (self.random.of(all), self.random.pose());
        let report = JointReport {
            position: self.random.0.signed(),
            rotation: self.random.rotation(),
            velocity: 0.1,
            moving_side: self.random.pose(),
            effort: 0.0,
        };
        let scene = &mut self.scene;
        match self.random.below(7) {
            // Refused by objects of other types, some of which are half changed by then.
            0 => drop(scene.report_joint(handle, &report)),
            1 => drop(scene.report_sensor(handle, pose)),
            2 => drop(scene.report_body(handle, Some(pose), Velocity::default())),
            3 => self.measure(Some(0.05).filter(|_| report.position > -0.9)),
            4 => scene.store_initial_state(),
            5 => scene.restore_initial_state(),
            _ => scene
                .modify(handle, Field::Measured, |object| {
                    object.dynamic_flag = DynamicFlags::RESPONDABLE;
                })
                .unwrap(),
        }
    }

    /// Velocities are those that looking at every object finds.
    fn measure(&mut self, dt: Option<f64>) {
        let expected: Vec<(Handle, MeasuredVelocity)> = (self.scene.objects())
            .map(|object| {
                let now = self.scene.world_pose(object.handle()).unwrap();
                (object.handle(), measured(object.measured.previous, now, dt))
            })
            .collect();
        self.scene.measure_velocities(dt);
        for (handle, expected) in expected {
            assert_eq!(
                self.scene.object(handle).unwrap().measured,
                expected,
                "{handle:?}"
            );
        }
    }

    #[track_caller]
    fn check(&self, handle: Handle) {
        let composed = self
            .scene
            .composed_pose(self.scene.object(handle).unwrap())
            .unwrap();
        assert_eq!(
            bits(&self.scene.world_pose(handle).unwrap()),
            bits(&composed),
            "{handle:?}"
        );
    }
}

/// Checks cached poses during `turns` random operations. `other` is one more operation, for tests of the layers above.
pub(crate) fn check_cached_poses(turns: usize, mut other: impl FnMut(&mut Scene, &mut Random)) {
    let mut play = Play {
        scene: Scene::new(),
        random: Random(random::Random::new(1)),
    };
    (0..25).for_each(|_| play.add());
    let mut most = 0;
    for turn in 0..turns {
        other(&mut play.scene, &mut play.random);
        let (all, joints) = (play.handles(), play.joints());
        match play.random.below(4) {
            0 if !joints.is_empty() => play.change_joint(&joints),
            1 => play.simulate(&all),
            _ => play.change_tree(&all),
        }
        let all = play.handles();
        most = most.max(all.len());
        // Changes accumulate for the objects that are not read now.
        for _ in 0..play.random.below(4) {
            let handle = play.random.of(&all);
            play.check(handle);
        }
        if turn % 50 == 0 {
            all.iter().for_each(|&handle| play.check(handle));
        }
    }
    assert!(most > 30, "some trees were large");
}

#[test]
fn cached_poses_equal_recomputed_ones() {
    check_cached_poses(20_000, |_, _| {});
}

#[test]
fn moving_a_parent_visits_no_child() {
    let mut scene = Scene::new();
    let dummy = |scene: &mut Scene| scene.add("d", Kind::Dummy(Dummy::new(0.01))).unwrap();
    let base = dummy(&mut scene);
    let children: Vec<Handle> = (0..3).map(|_| dummy(&mut scene)).collect();
    for &child in &children {
        scene.set_parent(child, Some(base), true).unwrap();
        scene.world_pose(child).unwrap();
    }
    let checked = |scene: &Scene, handle: Handle| scene.object(handle).unwrap().place.checked.get();
    let before = children
        .iter()
        .map(|&child| checked(&scene, child))
        .collect::<Vec<_>>();
    scene
        .set_local_pose(base, Pose::translation(1.0, 0.0, 0.0))
        .unwrap();
    assert!(
        children
            .iter()
            .map(|&child| checked(&scene, child))
            .eq(before)
    );
    assert_eq!(
        scene.world_pose(children[1]).unwrap(),
        Pose::translation(1.0, 0.0, 0.0)
    );
    // The base was checked on the way; the next child need not check it again.
    assert_eq!(checked(&scene, base), scene.objects.moves().last);
}

/// A chain of objects of random kinds and poses, each of which hangs on the one before.
fn chain(play: &mut Play, length: usize) -> Vec<Handle> {
    let mut all: Vec<Handle> = Vec::new();
    for _ in 0..length {
        let (kind, pose) = (play.random.kind(), play.random.pose());
        let new = play.scene.add("o", kind).unwrap();
        play.scene.set_world_pose(new, pose).unwrap();
        play.scene
            .set_parent(new, all.last().copied(), true)
            .unwrap();
        all.push(new);
    }
    all
}

fn empty_play() -> Play {
    Play {
        scene: Scene::new(),
        random: Random(random::Random::new(3)),
    }
}

#[test]
fn cached_poses_of_long_chains_equal_recomputed_ones() {
    let mut play = empty_play();
    let all = chain(&mut play, 300);
    for _ in 0..200 {
        let (moved, pose) = (play.random.of(&all), play.random.pose());
        let (taken, other) = (play.random.of(&all), play.random.of(&all));
        play.scene.set_local_pose(moved, pose).unwrap();
        let old = play.scene.object(taken).unwrap().parent();
        drop(play.scene.set_parent(taken, Some(other), true));
        for _ in 0..5 {
            let read = play.random.of(&all);
            play.check(read);
        }
        drop(play.scene.set_parent(taken, old, false));
    }
    all.iter().for_each(|&handle| play.check(handle));
}

#[test]
fn poses_are_composed_upwards() {
    let mut play = empty_play();
    let all = chain(&mut play, STRETCH as usize + 1);
    let upwards = |all: &[Handle]| {
        let mut objects = all.iter().map(|&h| play.scene.object(h).unwrap()).rev();
        let last = objects.next().unwrap().pose();
        objects.fold(last, |pose, object| {
            let pose = object.intrinsic_pose().map_or(pose, |own| own * pose);
            object.pose() * pose
        })
    };
    for length in [2, 3, 20, all.len()] {
        let read = play.scene.world_pose(all[length - 1]).unwrap();
        assert_eq!(bits(&read), bits(&upwards(&all[..length])), "{length}");
    }
}

/// Beyond a stretch the pose of its end in the world stands for all above it.
#[test]
fn poses_beyond_a_stretch_are_composed_from_its_end() {
    let mut play = empty_play();
    let stretch = STRETCH as usize;
    let all = chain(&mut play, 2 * stretch + 20);
    let object = |at: usize| play.scene.object(all[at]).unwrap();
    let world = |at: usize| play.scene.world_pose(all[at]).unwrap();
    for (end, at) in [
        (stretch, stretch + 1),
        (stretch, 2 * stretch),
        (2 * stretch, 2 * stretch + 19),
    ] {
        let upwards = (end + 1..at).rev().fold(object(at).pose(), |pose, above| {
            let own = object(above).intrinsic_pose();
            object(above).pose() * own.map_or(pose, |own| own * pose)
        });
        let of_end = object(end)
            .intrinsic_pose()
            .map_or(world(end), |own| world(end) * own);
        assert_eq!(bits(&world(at)), bits(&(of_end * upwards)), "{at}");
    }
}

/// Objects a metre apart along x, each on the one before, with slides that are pulled out along z and up.
#[test]
fn a_long_chain_is_as_long_as_its_links() {
    let mut scene = Scene::new();
    let mut all: Vec<Handle> = Vec::new();
    for at in 0..200 {
        let kind = if at % 32 == 0 {
            let slide = Joint::new(JointType::Prismatic, JointMode::Kinematic);
            Kind::Joint(Box::new(slide))
        } else {
            Kind::Dummy(Dummy::new(0.01))
        };
        let new = scene.add("o", kind).unwrap();
        scene.set_parent(new, all.last().copied(), false).unwrap();
        let pose = Pose::translation(1.0, 0.0, 0.0);
        scene.set_local_pose(new, pose).unwrap();
        if at % 32 == 0 {
            scene.set_joint_position(new, 0.25).unwrap();
        }
        all.push(new);
    }
    for at in [199, 64, 65, 128, 130, 0, 1] {
        let above = (at as f64 / 32.0).ceil();
        let expected = Pose::translation(at as f64 + 1.0, 0.0, 0.25 * above);
        let found = scene.world_pose(all[at]).unwrap();
        let gap = found.translation.vector - expected.translation.vector;
        assert!(gap.norm() < 1e-9, "{at}: {found}");
        assert!(found.rotation.angle() < 1e-9, "{at}: {found}");
    }
}

#[test]
fn poses_that_differ_in_one_number_have_other_bits() {
    let pose = Pose::translation(1.0, 2.0, 3.0);
    let turn = Vector3::new(0.0, 1e-9, 0.0);
    for other in [
        Pose::translation(1.0, 2.0, 3.0_f64.next_up()),
        Pose::new(Vector3::new(1.0, 2.0, 3.0), turn),
    ] {
        assert_ne!(bits(&pose), bits(&other));
    }
    assert_eq!(bits(&pose), bits(&pose.clone()));
}

#[test]
fn a_chain_is_built_without_visiting_all_of_it_each_time() {
    let mut play = empty_play();
    let all = chain(&mut play, 200);
    let place = |at: usize| &play.scene.object(all[at]).unwrap().place;
    assert!(place(0).checked.get() < place(10).checked.get());
    assert!(place(10).checked.get() < place(190).checked.get());
}
