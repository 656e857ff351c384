//! Chains that swing, light ones with heavy loads.

use geometry::MassProperties;

use super::*;

/// A straight chain of rods of 0.1 m at rest.
struct Chain {
    bench: Bench,
    links: Vec<Handle>,
    masses: Vec<f64>,
    /// From the way up, radians.
    incline: f64,
}

const LENGTH: f64 = 0.1;
impl Chain {
    fn new(joints: JointType, incline: f64, masses: Vec<f64>) -> Self {
        let mut bench = Bench::new();
        let mut parent = bench.ghost([0.0; 3], false);
        let turn = |angle: f64| nalgebra::UnitQuaternion::from_euler_angles(0.0, angle, 0.0);
        let at = |distance: f64| [incline.sin() * distance, 0.0, incline.cos() * distance];
        let mut links = Vec::new();
        for (i, &mass) in masses.iter().enumerate() {
            let joint = Kind::Joint(Box::new(Joint::new(joints, JointMode::Dynamic)));
            let joint = bench.object(joint, along_y(at(LENGTH * i as f64)), parent);
            parent = bench.ghost([0.0; 3], true);
            let place = nalgebra::Translation3::from(at(LENGTH * (i as f64 + 0.5)));
            bench
                .scene
                .set_world_pose(parent, Pose::from_parts(place, turn(incline)))
                .expect("exists");
            let rod = [LENGTH * LENGTH / 12.0, LENGTH * LENGTH / 12.0, 1e-4];
            let rod = MassProperties::diagonal(mass, rod);
            let made = bench.scene.try_modify(parent, Field::Dynamics, |object| {
                object.shape_mut()?.mass = rod;
                Ok(())
            });
            made.expect("a shape");
            bench.hang(parent, joint);
            links.push(parent);
        }
        Self {
            bench,
            links,
            masses,
            incline,
        }
    }

    /// Twenty links of 100 g, the last one as many times as heavy as the `load` says.
    fn loaded(joints: JointType, incline: f64, load: f64) -> Self {
        Self::new(
            joints,
            incline,
            (1..=20)
                .map(|i| if i == 20 { 0.1 * load } else { 0.1 })
                .collect(),
        )
    }

    fn energy(&self) -> f64 {
        self.links.iter().map(|&link| self.bench.energy(link)).sum()
    }

    /// Height above the hanging position, metres.
    fn fall(&self) -> f64 {
        let reach = |i: usize| LENGTH * (i as f64 + 0.5) * (1.0 + self.incline.cos());
        self.masses
            .iter()
            .enumerate()
            .map(|(i, mass)| mass * 9.81 * reach(i))
            .sum()
    }

    fn gap(&self) -> f64 {
        let end = |link: Handle, z: f64| {
            self.bench.scene.world_pose(link).expect("exists")
                * nalgebra::Point3::new(0.0, 0.0, z * LENGTH / 2.0)
        };
        let first = end(self.links[0], -1.0).coords.norm();
        self.links
            .windows(2)
            .map(|pair| (end(pair[0], 1.0) - end(pair[1], -1.0)).norm())
            .fold(first, f64::max)
    }

    /// Largest gap, and what energy is lost and gained at most, by what can fall, over so many seconds.
    fn swing(&mut self, seconds: f64) -> Swing {
        let start = self.energy();
        let mut swing = Swing {
            gap: 0.0,
            lost: 0.0,
            gained: 0.0,
        };
        for _ in 0..(seconds / STEP).round() as usize {
            self.bench.run(1);
            let gained = (self.energy() - start) / self.fall();
            let now = Swing {
                gap: self.gap(),
                lost: -gained,
                gained,
            };
            assert!(now.gap.is_finite() && gained.is_finite());
            swing = Swing {
                gap: swing.gap.max(now.gap),
                lost: swing.lost.max(now.lost),
                gained: swing.gained.max(now.gained),
            };
        }
        swing
    }
}

#[derive(Debug)]
struct Swing {
    gap: f64,
    lost: f64,
    gained: f64,
}

#[test]
fn a_chain_swings_with_a_load_of_any_mass() {
    for load in [1e3, 1e6] {
        let swing = Chain::loaded(JointType::Revolute, 2.6, load).swing(1.5);
        assert!(
            swing.gap < 1e-6 && swing.lost < 0.02 && swing.gained < 0.02,
            "{load}: {swing:?}"
        );
    }
}

#[test]
fn a_rope_of_ball_joints_swings_down_with_a_heavy_load() {
    let swing = Chain::loaded(JointType::Spherical, std::f64::consts::FRAC_PI_2, 1e3).swing(2.0);
    assert!(
        swing.gap < 1e-6 && swing.lost < 0.1 && swing.gained < 0.02,
        "{swing:?}"
    );
}

/// It folds, and is pulled straight with a jerk: a shock, in which energy may be lost and not come from anywhere.
#[test]
fn a_chain_that_is_pulled_straight_holds() {
    let swing = Chain::loaded(JointType::Revolute, 0.5, 1e3).swing(1.5);
    assert!(
        swing.gap < 1e-3 && swing.lost > 0.1 && swing.gained < 0.02,
        "{swing:?}"
    );
}

#[test]
fn a_heavy_load_on_a_chain_hits_the_ground() {
    let mut chain = Chain::loaded(JointType::Revolute, std::f64::consts::FRAC_PI_2, 1e3);
    chain
        .bench
        .shape([10.0, 10.0, 0.1], [0.0, 0.0, -1.05], 1.0, false, true);
    let load = *chain.links.last().expect("twenty links");
    let made = chain
        .bench
        .scene
        .try_modify(load, Field::Dynamics, |object| {
            object.shape_mut()?.dynamics.respondable = true;
            Ok(())
        });
    made.expect("a shape");
    let swing = chain.swing(2.0);
    assert!(swing.gap < 1e-3 && swing.gained < 0.02, "{swing:?}");
}

/// The chain whips about faster than can be followed, so that its spins are bounded; the arm is not.
#[test]
fn an_arm_moves_the_same_beside_a_wild_chain() {
    let mut alone = Bench::new();
    let mut chain = Chain::loaded(JointType::Revolute, 0.5, 10.0);
    let [lone, beside] = [&mut alone, &mut chain.bench].map(|bench| bench.arm(0.02, 0.1, |_| {}).0);
    alone.run(30);
    chain.bench.run(30);
    assert_eq!(
        alone.joint(lone).position,
        chain.bench.joint(beside).position
    );
}

/// A body that falls is moved by rapier, and everything with it; an arm alone by its mechanism.
#[test]
fn an_arm_moves_alike_with_rapier_and_without() {
    let (mut alone, mut beside) = (Bench::new(), Bench::new());
    beside.shape([0.1; 3], [5.0, 0.0, 100.0], 1.0, true, true);
    let [lone, other] = [&mut alone, &mut beside].map(|bench| {
        let joint = bench.arm(0.02, 0.1, |_| {}).0;
        bench.run(30);
        joint
    });
    let is_integrated = [&alone, &beside].map(|bench| {
        let world = bench.dynamics.world.as_ref().expect("it was stepped");
        bench.dynamics.mechanisms.can_integrate(world)
    });
    assert_eq!(is_integrated, [true, false]);
    near(
        alone.joint(lone).position,
        beside.joint(other).position,
        1e-3,
    );
}

#[test]
fn a_swinging_chain_keeps_its_energy() {
    let mut bench = Bench::new();
    let mut parent = bench.ghost([0.0, 0.0, 1.0], false);
    let mut links = Vec::new();
    for i in 0..2 {
        let x = 0.2 * f64::from(i);
        let joint = Joint::new(JointType::Revolute, JointMode::Dynamic);
        let joint = bench.object(Kind::Joint(Box::new(joint)), along_y([x, 0.0, 1.0]), parent);
        parent = bench.shape([0.2, 0.05, 0.05], [x + 0.1, 0.0, 1.0], 1.0, true, false);
        bench.hang(parent, joint);
        links.push(parent);
    }
    let energy = |bench: &Bench| -> f64 { links.iter().map(|&link| bench.energy(link)).sum() };
    let before = energy(&bench);
    bench.run(100);
    near(energy(&bench), before, 0.05);
}

#[test]
fn a_chain_of_twenty_links_carries_a_load_a_hundred_times_as_heavy() {
    let mut bench = Bench::new();
    let mut parent = bench.ghost([0.0, 0.0, 3.0], false);
    for i in 0..20 {
        let z = 3.0 - 0.1 * f64::from(i);
        let joint = Kind::Joint(Box::new(Joint::new(
            JointType::Revolute,
            JointMode::Dynamic,
        )));
        let joint = bench.object(joint, along_y([0.0, 0.0, z]), parent);
        let mass = if i == 19 { 100.0 } else { 1.0 };
        parent = bench.shape([0.02, 0.02, 0.1], [0.01, 0.0, z - 0.05], mass, true, false);
        bench.hang(parent, joint);
    }
    bench.run(100);
    near(bench.height(parent), 1.05, 0.01);
}
