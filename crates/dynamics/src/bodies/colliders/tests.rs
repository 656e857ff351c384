//! Forms have the extents, the volumes and the places of the shapes they stand for.

use std::f64::consts::PI;
use std::rc::Rc;

use rapier3d_f64::parry::bounding_volume::BoundingVolume;
use scene::Pose;

use super::*;

const SIZE: [f64; 3] = [0.2, 0.2, 0.5];

fn part(mesh: Mesh, kind: Option<PrimitiveKind>, convex: bool) -> PartForm {
    PartForm {
        mesh: Rc::new(mesh),
        pose: Pose::translation(1.0, 2.0, 3.0),
        primitive: kind.map(|kind| Primitive {
            kind,
            size: SIZE,
            heights: None,
        }),
        convex,
    }
}

fn formed(part: &PartForm, dynamic: bool) -> Vec<(EnginePose, SharedShape)> {
    let mut made = Forms::default();
    let wanted = making(part, dynamic).map(|making| (&part.mesh, making));
    made.make_all(wanted.into_iter());
    forms(part, dynamic, &made)
}

/// Half extents and volume of the only form of a part, about the place of the part.
fn extents(part: &PartForm) -> ([f64; 3], f64) {
    let [(pose, form)] = &formed(part, true)[..] else {
        panic!("a primitive has one form");
    };
    let aabb = form.compute_aabb(pose);
    let offset = aabb.center() - Vector::new(1.0, 2.0, 3.0);
    assert!(offset.length() < 1e-9, "{offset:?}");
    (aabb.half_extents().into(), form.mass_properties(1.0).mass())
}

#[test]
fn primitives_have_their_extents_and_volumes() {
    let (area, thin) = (PI * 0.01, MIN_THICKNESS);
    let ball = area * 0.1 * 4.0 / 3.0;
    let cases = [
        (PrimitiveKind::Cuboid, 0.25, 0.02),
        (PrimitiveKind::Plane, thin / 2.0, 0.04 * thin),
        (PrimitiveKind::Disc, thin / 2.0, area * thin),
        (PrimitiveKind::Spheroid, 0.1, ball),
        (PrimitiveKind::Cylinder, 0.25, area * 0.5),
        (PrimitiveKind::Cone, 0.25, area * 0.5 / 3.0),
        (PrimitiveKind::Capsule, 0.25, area * 0.3 + ball),
    ];
    for (kind, height, volume) in cases {
        let (half, found) = extents(&part(Mesh::default(), Some(kind), true));
        for (extent, expected) in half.into_iter().zip([0.1, 0.1, height]) {
            assert!((extent - expected).abs() < 1e-9, "{kind:?} {half:?}");
        }
        assert!((found / volume - 1.0).abs() < 1e-6, "{kind:?} {found}");
    }
}

fn block(size: [f64; 3]) -> Mesh {
    let made = geometry::primitive::tessellate(PrimitiveKind::Cuboid, size, false);
    made.expect("its extents are finite")
}

#[test]
fn meshes_become_hulls_pieces_or_surfaces() {
    let size = [0.2, 0.4, 0.6];
    let kind = |mesh: Mesh, convex, dynamic| making(&part(mesh, None, convex), dynamic);
    assert_eq!(kind(block(size), true, true), Some(Making::Hull));
    assert_eq!(kind(block(size), true, false), Some(Making::Hull));
    assert_eq!(kind(block(size), false, true), Some(Making::Pieces));
    assert_eq!(kind(block(size), false, false), Some(Making::Surface));
    // Flat, without extent, too large, and without a triangle.
    assert_eq!(
        kind(block([0.2, 0.4, 0.0]), false, true),
        Some(Making::Surface)
    );
    assert_eq!(kind(block([1e-8; 3]), true, true), None);
    assert_eq!(kind(block([1e7, 1.0, 1.0]), true, true), None);
    assert_eq!(kind(Mesh::default(), true, true), None);
    let corners = vec![[0.0; 3], [0.2, 0.0, 0.0], [0.0, 0.3, 0.0]];
    let triangle = Mesh::new(corners, vec![[0, 1, 2]]).expect("it has its vertices");
    assert_eq!(kind(triangle, false, true), Some(Making::Surface));
    let hull = part(block(size), None, true);
    let (half, volume) = extents(&hull);
    let expected = size.map(|extent| extent / 2.0);
    assert!((0..3).all(|axis| (half[axis] - expected[axis]).abs() < 1e-9));
    assert!((volume - 0.048).abs() < 1e-9, "{volume}");
}

fn turned(angle: f64) -> (EnginePose, SharedShape) {
    let pose = EnginePose::from_rotation(Rotation::from_rotation_x(angle));
    (pose, SharedShape::cuboid(0.1, 0.2, 0.3))
}

/// The extents of all parts of colliders, and their volume.
fn whole(forms: &[(EnginePose, SharedShape)]) -> (Vector, Vector, f64) {
    let boxes = forms.iter().map(|(pose, form)| form.compute_aabb(pose));
    let whole = boxes.reduce(|a, b| a.merged(&b)).expect("there are some");
    let volumes = forms
        .iter()
        .map(|(_, form)| form.mass_properties(1.0).mass());
    (whole.mins, whole.maxs, volumes.sum())
}

#[test]
fn several_turned_forms_become_one_that_is_upright() {
    let one = with_few_colliders(vec![turned(0.0), turned(0.5)]);
    assert!(one.iter().all(|(_, form)| form.as_cuboid().is_some()));
    let before = vec![turned(0.3), turned(0.5)];
    let after = with_few_colliders(before.clone());
    assert!(matches!(&after[..], [(pose, _)] if *pose == EnginePose::IDENTITY));
    let [a, b] = [&before, &after].map(|forms| whole(forms));
    assert!((a.0 - b.0).length() < 1e-9 && (a.1 - b.1).length() < 1e-9);
    assert!((a.2 - b.2).abs() < 1e-9);
}

#[test]
fn many_forms_are_one_collider_beside_surfaces() {
    let upright = |x: f64| {
        let form = SharedShape::cuboid(0.1, 0.1, 0.1);
        (EnginePose::from_translation(Vector::new(x, 0.0, 0.0)), form)
    };
    let few: Vec<_> = (0..8).map(|i| upright(f64::from(i))).collect();
    assert_eq!(with_few_colliders(few.clone()).len(), 8);
    let sheet = surface(&block([0.2, 0.4, 0.0])).expect("it has triangles");
    let many = [few, vec![(EnginePose::IDENTITY, sheet), upright(8.0)]].concat();
    let joined = with_few_colliders(many.clone());
    assert_eq!(joined.len(), 2);
    let group = joined[0].1.as_compound().expect("the convex ones are one");
    assert_eq!(group.shapes().len(), 9);
    let [a, b] = [&many, &joined].map(|forms| whole(forms));
    assert!((a.0 - b.0).length() < 1e-9 && (a.1 - b.1).length() < 1e-9);
}
