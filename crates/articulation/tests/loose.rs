//! Free bodies without joints, and their contacts.

use articulation::{BodyMotion, BodyProperties, BodyState, Contact, Mechanism};
use geometry::Pose;
use nalgebra::{Matrix3, Vector3, Vector6};

const STEP: f64 = 0.005;
const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];
const SIDE: f64 = 0.1;

fn cube(mass: f64) -> BodyProperties {
    BodyProperties::dynamic(
        mass,
        Matrix3::identity() * (mass * SIDE * SIDE / 6.0),
        Vector3::zeros(),
    )
}

fn at(z: f64, velocity: Vector3<f64>) -> BodyState {
    let mut motion = BodyMotion {
        pose: Pose::translation(0.0, 0.0, z),
        velocity: Vector6::zeros(),
    };
    motion.velocity.fixed_rows_mut::<3>(0).copy_from(&velocity);
    BodyState {
        motion,
        force: Vector6::zeros(),
        gyroscopic_velocity: Vector3::zeros(),
        target: None,
    }
}

/// The corners of the lower face of a cube, on another one or on the ground.
fn corners(upper: usize, lower: Option<usize>, z: f64, friction: f64) -> Vec<Contact> {
    let half = SIDE / 2.0;
    [[-half, -half], [-half, half], [half, -half], [half, half]]
        .map(|[x, y]| Contact {
            bodies: [Some(upper), lower],
            base: None,
            point: [x, y, z],
            normal: [0.0, 0.0, 1.0],
            distance: 0.0,
            friction,
            restitution: 0.0,
            velocity: [0.0; 3],
            impulse: [0.0; 3],
        })
        .into()
}

#[test]
fn a_tower_of_boxes_bears_itself() {
    for count in [1, 2, 3, 10] {
        let mut tower = Mechanism::new(Vec::new(), Vec::new());
        tower.set_guests((0..count).map(|_| cube(1.0)));
        let height = |level: usize| SIDE * (level as f64 + 0.5);
        let states: Vec<BodyState> = (0..count)
            .map(|level| at(height(level), Vector3::zeros()))
            .collect();
        tower.begin(&states, &[], GRAVITY, STEP);
        let contacts: Vec<Contact> = (0..count)
            .flat_map(|level| corners(level, level.checked_sub(1), SIDE * level as f64, 0.5))
            .collect();
        tower.set_contacts(&contacts);
        assert!(tower.solve());
        let pushes: Vec<f64> = tower.contact_impulses().map(|impulse| impulse[2]).collect();
        for (level, pushes) in pushes.chunks(4).enumerate() {
            let weight = 9.81 * STEP * (count - level) as f64;
            let sum: f64 = pushes.iter().sum();
            assert!(
                (sum - weight).abs() < 1e-3 * weight,
                "{count} {level}: {pushes:?} {weight}"
            );
        }
        for velocity in tower.velocities() {
            assert!(velocity.amax() < 1e-4, "{count}: {velocity}");
        }
    }
}
