//! The mass of a body as rapier takes it.

use rapier3d_f64::math::{Pose as EnginePose, Rotation};
use rapier3d_f64::prelude::MassProperties;

use crate::convert::{to_rotation, to_vector};

/// Centre of mass, mass and inertia. rapier's own decomposition of an inertia takes moments for equal where their differences have a product
/// below 1e-10 kg2 m4, and any two equal moments for those of the first two axes: light bodies and plates across x would turn with swapped moments.
pub(super) fn mass_properties(mass: &geometry::MassProperties) -> MassProperties {
    let (axes, moments) = mass.principal_axes();
    let moments = moments.map(|moment| moment * mass.mass);
    MassProperties::with_principal_inertia_frame(
        to_vector(mass.com),
        mass.mass,
        to_vector(moments),
        to_rotation(&axes),
    )
}

/// Which collider is to carry the mass of its body; None for the body itself. rapier adds the masses of colliders, and decomposes each sum anew, badly (see
/// [`mass_properties`]), unless one of the two is zero to the last digit: a collider without mass that is turned is not. The only one that is turned can carry
/// the mass; with several turned ones none is left turned ([`with_few_colliders`](super::colliders::with_few_colliders)).
pub(super) fn carrier<'a>(poses: impl Iterator<Item = &'a EnginePose>) -> Option<usize> {
    let mut turned = poses
        .enumerate()
        .filter(|(_, pose)| pose.rotation != Rotation::IDENTITY);
    let first = turned.next().map(|(index, _)| index);
    first.filter(|_| turned.next().is_none())
}

/// What a collider without mass is to have so that it is zero to the last digit in the frame of its body, if it is not turned.
pub(super) fn massless(pose: &EnginePose) -> MassProperties {
    MassProperties {
        local_com: -pose.translation,
        ..MassProperties::default()
    }
}
