//! Texture coordinates of images that are projected onto meshes.
//!
//! The image lies in the x-y plane of its own frame, centred, and is `scale` metres large: on a plane as it is, on a cylinder wrapped
//! around the z axis, on a sphere with its poles on the z axis, on a cube from the three axes onto the faces that look along them.

use std::f64::consts::{PI, TAU};

use geometry::Mesh;
use nalgebra::{Point3, Vector3};

use scene::appearance::texture_mapping::{MappingMode, TextureMapping};

/// Numbers that decide about the coordinates of a mesh.
pub(super) fn key(mapping: &TextureMapping) -> (i32, [u64; 9]) {
    let (place, turn) = (
        mapping.frame.translation.vector,
        mapping.frame.rotation.coords,
    );
    let numbers = [
        mapping.scale[0],
        mapping.scale[1],
        place.x,
        place.y,
        place.z,
        turn[0],
        turn[1],
        turn[2],
        turn[3],
    ];
    (mapping.mode.0, numbers.map(f64::to_bits))
}

/// Texture coordinates of each corner of each triangle.
pub(super) fn coordinates(mesh: &Mesh, mapping: &TextureMapping) -> Vec<[f32; 2]> {
    let into_frame = mapping.frame.inverse();
    let point = |vertex: u32| (into_frame * Point3::from(mesh.vertices[vertex as usize])).coords;
    let corners = mesh.triangles.iter().map(|corners| corners.map(point));
    corners
        .flat_map(|corners| of_triangle(&corners, mapping))
        .collect()
}

fn of_triangle(corners: &[Vector3<f64>; 3], mapping: &TextureMapping) -> [[f32; 2]; 3] {
    let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
    let mut places = corners.map(|corner| match mapping.mode {
        MappingMode::CYLINDER => [turns(&corner), corner.z],
        MappingMode::SPHERE => [turns(&corner), elevation(&corner)],
        MappingMode::CUBE => on_cube(&corner, &normal),
        _ => [corner.x, corner.y],
    });
    if matches!(mapping.mode, MappingMode::CYLINDER | MappingMode::SPHERE) {
        close_seam(&mut places);
    }
    let scale = mapping
        .scale
        .map(|scale| if scale == 0.0 { 1.0 } else { scale });
    places.map(|place| [0, 1].map(|axis| (place[axis] / scale[axis] + 0.5) as f32))
}

/// Around the z axis, in turns from -1/2 to 1/2.
fn turns(point: &Vector3<f64>) -> f64 {
    libm::atan2(point.y, point.x) / TAU
}

/// From pole to pole, -1/2 to 1/2.
fn elevation(point: &Vector3<f64>) -> f64 {
    libm::atan2(point.z, point.xy().norm()) / PI
}

/// As seen along the axis that the surface faces most.
fn on_cube(point: &Vector3<f64>, normal: &Vector3<f64>) -> [f64; 2] {
    match normal.iamax() {
        0 => [point.y * normal.x.signum(), point.z],
        1 => [-point.x * normal.y.signum(), point.z],
        _ => [point.x * normal.z.signum(), point.y],
    }
}

/// A triangle across the place where the turns begin again continues beyond it.
fn close_seam(places: &mut [[f64; 2]; 3]) {
    let last = places.iter().map(|place| place[0]).fold(f64::MIN, f64::max);
    for place in places {
        if last - place[0] > 0.5 {
            place[0] += 1.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Pose;
    use scene::appearance::texture_mapping::TextureSource;

    fn mapping(mode: MappingMode) -> TextureMapping {
        let mapping = TextureMapping::new(TextureSource::Texture(2_180_009));
        TextureMapping {
            mode,
            scale: [2.0, 4.0],
            ..mapping
        }
    }

    fn triangle(corners: [[f64; 3]; 3]) -> Mesh {
        Mesh::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap()
    }

    #[test]
    fn a_plane_is_measured_in_images_from_its_middle() {
        let mesh = triangle([[0.0, 0.0, 0.0], [1.0, 0.0, 5.0], [1.0, 2.0, 0.0]]);
        assert_eq!(
            coordinates(&mesh, &mapping(MappingMode::PLANE)),
            [[0.5, 0.5], [1.0, 0.5], [1.0, 1.0]]
        );
        let moved = TextureMapping {
            frame: Pose::translation(1.0, 0.0, 0.0),
            ..mapping(MappingMode::PLANE)
        };
        assert_eq!(coordinates(&mesh, &moved)[1], [0.5, 0.5]);
    }

    #[test]
    fn a_triangle_across_the_seam_is_not_turned_around() {
        let mesh = triangle([[-1.0, 0.1, 0.0], [-1.0, -0.1, 0.0], [-1.0, 0.0, 1.0]]);
        let u: Vec<f32> = coordinates(&mesh, &mapping(MappingMode::CYLINDER))
            .iter()
            .map(|uv| uv[0])
            .collect();
        assert!(u.iter().all(|u| (u - 0.75).abs() < 0.02), "{u:?}");
    }

    #[test]
    fn faces_of_a_cube_are_seen_from_outside() {
        let mesh = triangle([[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 1.0]]);
        assert_eq!(
            coordinates(&mesh, &mapping(MappingMode::CUBE)),
            [[0.5, 0.5], [1.0, 0.5], [0.5, 0.75]]
        );
    }

    #[test]
    fn each_face_of_a_cube_has_its_right_side_to_the_right() {
        // Seen from outside, the second corner lies to the right of the first and the third one above it.
        let right = |corners: [[f64; 3]; 3]| {
            let found = coordinates(&triangle(corners), &mapping(MappingMode::CUBE));
            [
                [found[1][0] - found[0][0], found[2][1] - found[0][1]],
                [found[1][1] - found[0][1], found[2][0] - found[0][0]],
            ]
        };
        let z = [0.0, 0.0, 1.0];
        for (at, across, up) in [
            ([3.0, 0.0, 0.0], [0.0, 1.0, 0.0], z),
            ([-3.0, 0.0, 0.0], [0.0, -1.0, 0.0], z),
            ([0.0, 3.0, 0.0], [-1.0, 0.0, 0.0], z),
            ([0.0, -3.0, 0.0], [1.0, 0.0, 0.0], z),
            ([0.0, 0.0, 3.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
            ([0.0, 0.0, -3.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
        ] {
            // The normal is far from one metre long.
            let beside = |way: [f64; 3]| [0, 1, 2].map(|i| at[i] + 2.0 * way[i]);
            assert_eq!(
                right([at, beside(across), beside(up)]),
                [[1.0, 0.5], [0.0; 2]],
                "{at:?}"
            );
        }
    }

    #[test]
    fn a_sphere_has_its_poles_on_the_z_axis() {
        let ball = TextureMapping {
            scale: [1.0; 2],
            ..mapping(MappingMode::SPHERE)
        };
        let mesh = triangle([[2.0, 0.0, 0.0], [2.0, 0.0, 2.0], [0.0, 3.0, 0.0]]);
        let found = coordinates(&mesh, &ball);
        // A turn around z, and half a turn from pole to pole.
        let expected = [[0.5, 0.5], [0.5, 0.75], [0.75, 0.5]];
        for (found, expected) in found.iter().zip(&expected) {
            assert!(
                (0..2).all(|i| (found[i] - expected[i]).abs() < 1e-6),
                "{found:?}"
            );
        }
        let pole = triangle([[0.0, 0.0, 5.0], [0.0, 0.0, -5.0], [1.0, 0.0, 0.0]]);
        let ends = coordinates(&pole, &ball);
        assert!(
            (ends[0][1] - 1.0).abs() < 1e-6 && ends[1][1].abs() < 1e-6,
            "{ends:?}"
        );
    }

    #[test]
    fn mappings_that_differ_in_a_number_have_other_keys() {
        let plane = mapping(MappingMode::PLANE);
        let wide = TextureMapping {
            scale: [3.0, 4.0],
            ..plane.clone()
        };
        let moved = TextureMapping {
            frame: Pose::translation(0.0, 0.0, 1.0),
            ..plane.clone()
        };
        let all = [plane.clone(), wide, moved, mapping(MappingMode::CUBE)];
        for (at, one) in all.iter().enumerate() {
            for (other_at, other) in all.iter().enumerate() {
                assert_eq!(key(one) == key(other), at == other_at);
            }
        }
    }
}
