//! Mass, centre and inertia against closed forms, and what becomes of values that no body has.

use super::*;
use crate::pose::IDENTITY_MATRIX;

#[track_caller]
fn close(a: &[f64], b: &[f64], tolerance: f64) {
    let near = a.len() == b.len() && a.iter().zip(b).all(|(x, y)| (x - y).abs() <= tolerance);
    assert!(near, "{a:?} is not {b:?}");
}

fn primitive(kind: PrimitiveKind, size: [f64; 3]) -> MassProperties {
    MassProperties::of_primitive_at_creation(kind, size, 500.0)
}

#[test]
fn inertia_follows_the_mass_and_reads_the_upper_triangle_s8_s9() {
    let mut s = primitive(PrimitiveKind::Cuboid, [0.1, 0.2, 0.3]);
    s.set_mass(6.0);
    close(
        &s.absolute_inertia(),
        &[0.065, 0., 0., 0., 0.05, 0., 0., 0., 0.025],
        1e-9,
    );
    let quarter = [0., -1., 0., 0.1, 1., 0., 0., 0., 0., 0., 1., 0.];
    s.set_absolute_inertia(&[1., 0., 0., 0., 2., 0., 0., 0., 3.], &quarter);
    close(
        &s.absolute_inertia(),
        &[2., 0., 0., 0., 1., 0., 0., 0., 3.],
        1e-12,
    );
    close(
        &s.com_matrix(),
        &[1., 0., 0., 0.1, 0., 1., 0., 0., 0., 0., 1., 0.],
        1e-12,
    );
    s.set_absolute_inertia(&[1., 0.1, 0., 99., 2., 0., 99., 99., 3.], &IDENTITY_MATRIX);
    s.set_mass(3.0);
    close(
        &s.absolute_inertia(),
        &[0.5, 0.05, 0., 0.05, 1., 0., 0., 0., 1.5],
        1e-12,
    );
    s.set_mass(f64::NAN);
    s.set_absolute_inertia(&[f64::NAN; 9], &IDENTITY_MATRIX);
    assert_eq!(s.mass, 3.0);
    s.set_mass(-1.0);
    assert_eq!(s.mass, MIN_MASS);
}

#[test]
fn grouping_uses_parallel_axes_s10() {
    let cube = primitive(PrimitiveKind::Cuboid, [0.1; 3]);
    let group = MassProperties::combine(&[
        (Pose::translation(-0.4, 0., 0.), cube),
        (Pose::identity(), cube),
    ]);
    let group = group.expect("two parts");
    close(&group.com, &[-0.2, 0., 0.], 1e-12);
    close(
        &group.absolute_inertia(),
        &[
            0.001666667,
            0.,
            0.,
            0.,
            0.041666667,
            0.,
            0.,
            0.,
            0.041666667,
        ],
        1e-9,
    );
    assert_eq!(MassProperties::combine(&[]), None);
}

#[test]
fn grouping_of_rotated_members() {
    let at = |p: [f64; 3], e: [f64; 3]| pose_from_matrix(&crate::pose::euler::build_matrix(&p, &e));
    let (a, b) = (
        at([0.1, 0.2, 0.3], [0.4, 0.5, 0.6]),
        at([-0.5, 0.1, 0.2], [1., 0.2, 0.1]),
    );
    let box_ = primitive(PrimitiveKind::Cuboid, [0.1, 0.2, 0.3]);
    let rod = primitive(PrimitiveKind::Cylinder, [0.2, 0.2, 0.5]);
    let group = MassProperties::combine(&[(b.inverse() * a, box_), (Pose::identity(), rod)])
        .expect("two parts");
    close(&[group.mass], &[10.853981634], 1e-9);
    close(&group.com, &[0.167178370, 0.021609668, 0.024788617], 1e-9);
    let expected = [
        0.242765781,
        -0.103793096,
        -0.124664706,
        -0.103793096,
        1.017434133,
    ];
    close(&group.absolute_inertia()[..5], &expected, 1e-9);
    let (axes, moments) = group.principal_axes();
    let principal = MassProperties {
        inertia: Matrix3::from_diagonal(&moments.into()),
        ..group
    };
    let back = principal.reexpressed(&Pose::from_parts(nalgebra::Translation3::identity(), axes));
    close(&back.absolute_inertia(), &group.absolute_inertia(), 1e-12);
}

#[test]
fn scaling_goes_with_the_fifth_power() {
    let body = MassProperties {
        com: [1., 2., 3.],
        ..primitive(PrimitiveKind::Cuboid, [0.1, 0.2, 0.3])
    };
    let scaled = body.scaled(2.0);
    close(&scaled.com, &[2., 4., 6.], 0.0);
    close(
        &scaled.absolute_inertia(),
        &body.absolute_inertia().map(|i| 32.0 * i),
        1e-12,
    );
    assert_eq!(body.scaled(f64::NAN), body);
}

#[test]
fn computed_primitives_are_exact() {
    let check = |kind, size, expected: [f64; 4]| {
        let p = compute_mass_and_inertia(Some((kind, size)), &[], 1000.0).expect("solid");
        let i = p.absolute_inertia();
        close(&[p.mass, i[0], i[4], i[8]], &expected, 1e-9);
    };
    check(
        PrimitiveKind::Cuboid,
        [0.1, 0.2, 0.3],
        [6.0, 0.065, 0.05, 0.025],
    );
    check(
        PrimitiveKind::Spheroid,
        [0.2; 3],
        [4.188790205, 0.016755161, 0.016755161, 0.016755161],
    );
    check(
        PrimitiveKind::Cylinder,
        [0.2, 0.2, 0.4],
        [12.566370614, 0.198967535, 0.198967535, 0.062831853],
    );
    check(
        PrimitiveKind::Capsule,
        [0.2, 0.2, 0.5],
        [13.613568166, 0.252374610, 0.252374610, 0.063879051],
    );
}

#[test]
fn computed_meshes_are_their_solid_hull_s12() {
    let vertices = [
        [0., 0., 0.],
        [1., 0., 0.],
        [0., 1., 0.],
        [0., 0., 1.],
        [0.1, 0.1, 0.1],
    ];
    let p = compute_mass_and_inertia(None, &vertices, 1200.0).expect("solid");
    close(&[p.mass], &[200.0], 1e-9);
    close(&p.com, &[0.25; 3], 1e-12);
    close(
        &p.absolute_inertia(),
        &[15., 2.5, 2.5, 2.5, 15., 2.5, 2.5, 2.5, 15.],
        1e-9,
    );
    assert_eq!(compute_mass_and_inertia(None, &vertices[..3], 1200.0), None);
    assert_eq!(compute_mass_and_inertia(None, &[], 1200.0), None);
    assert_eq!(compute_mass_and_inertia(None, &vertices, f64::NAN), None);
    assert_eq!(
        compute_mass_and_inertia(Some((PrimitiveKind::Plane, [1.; 3])), &[], 1.0),
        None
    );
}

#[test]
fn inertias_that_no_body_has_become_positive() {
    let body = |inertia: Matrix3<f64>| MassProperties {
        inertia,
        ..MassProperties::default()
    };
    // All nine numbers equal, as robots' files have it: the moments are 3, 0 and 0.
    let raised = body(Matrix3::repeat(1.0)).with_positive_moments();
    close(&raised.principal_axes().1, &[1.5, 1.5, 3.0], 1e-7);
    // The axis of the largest moment stays.
    assert!((raised.inertia * Vector3::repeat(1.0) - Vector3::repeat(3.0)).norm() < 1e-7);
    let raised =
        body(Matrix3::from_diagonal(&Vector3::new(9.0, -4.0, 3.0))).with_positive_moments();
    close(
        &[
            raised.inertia[(0, 0)],
            raised.inertia[(1, 1)],
            raised.inertia[(2, 2)],
        ],
        &[9.0, 3.0, 6.0],
        1e-7,
    );
    // A rod without thickness gets the smallest one; a body that only is unusual stays.
    let rod = body(Matrix3::from_diagonal(&Vector3::new(0.0, 1.0, 1.0))).with_positive_moments();
    assert_eq!(rod.inertia.diagonal(), Vector3::new(MIN_MOMENT, 1.0, 1.0));
    let unusual = body(Matrix3::new(1.0, 0.1, 0.0, 0.1, 2.0, 0.0, 0.0, 0.0, 30.0));
    assert_eq!(unusual.with_positive_moments(), unusual);
    let nothing = body(Matrix3::zeros()).with_positive_moments();
    assert_eq!(nothing.inertia, Matrix3::from_diagonal_element(MIN_MOMENT));
    assert!(
        body(Matrix3::repeat(f64::NAN))
            .with_positive_moments()
            .inertia[(0, 0)]
            .is_nan()
    );
}

#[test]
fn principal_moments_are_limited_and_survive_bad_numbers() {
    let point = MassProperties::diagonal(1.0, [0.0; 3]);
    assert_eq!(point.principal_axes().1, [MIN_MOMENT; 3]);
    let bad = MassProperties {
        inertia: Matrix3::repeat(f64::NAN),
        ..point
    };
    assert_eq!(bad.principal_axes().0, UnitQuaternion::identity());
}

#[test]
fn masses_and_moments_are_bounded_and_balanced_as_mujoco_does() {
    let body = MassProperties::diagonal(2.0, [1.0, 1.0, 3.0]);
    assert_eq!(body.bounded(0.0, 0.0, false), body);
    assert_eq!(body.bounded(2.0, 2.0, false), body);
    // 2, 2 and 6 kg m2 are no moments of a body: their mean is 10 / 3.
    let balanced = body.bounded(0.0, 0.0, true).absolute_inertia();
    assert!(
        [0, 4, 8]
            .iter()
            .all(|i| (balanced[*i] - 10.0 / 3.0).abs() < 1e-12)
    );
    let bounded = body.bounded(5.0, 2.5, false);
    let moments = bounded.absolute_inertia();
    assert_eq!(bounded.mass, 5.0);
    for (place, moment) in [(0, 2.5), (4, 2.5), (8, 6.0)] {
        assert!((moments[place] - moment).abs() < 1e-12, "{moments:?}");
    }
    assert_eq!(body.bounded(f64::INFINITY, 0.0, true), body);
}
