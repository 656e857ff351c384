//! The primitive shapes of `sim.createPrimitiveShape`: meshes, sizes, mass at creation.
//!
//! Sizes are full extents along x, y, z (m), centred on the frame; axes of revolution lie along z, the apex of
//! a cone towards +z.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::Mesh;

/// Sides of rotational solids.
const SIDES: u32 = 32;
/// Rings of triangles from pole to pole of a sphere; half of them on each cap of a capsule.
const RINGS: u32 = 16;
/// Range of sizes (m).
const SIZES: (f64, f64) = (1e-5, 1e5);
/// Thickness of planes and discs in the computation of mass (m).
const SHEET: f64 = 0.001;

/// The kind of a primitive, with its number in scripts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PrimitiveKind {
    /// Rectangle with normal +z.
    Plane = 1,
    /// Flat circle with normal +z.
    Disc = 2,
    /// Box.
    Cuboid = 3,
    /// Sphere or ellipsoid.
    Spheroid = 4,
    /// Cylinder.
    Cylinder = 5,
    /// Cone.
    Cone = 6,
    /// Terrain, see [`heightfield`].
    Heightfield = 7,
    /// Cylinder between two half balls; z is the total length.
    Capsule = 8,
}

impl PrimitiveKind {
    /// The kind with a script's number, if there is one.
    pub fn from_code(code: i64) -> Option<Self> {
        use PrimitiveKind::*;
        [
            Plane,
            Disc,
            Cuboid,
            Spheroid,
            Cylinder,
            Cone,
            Heightfield,
            Capsule,
        ]
        .into_iter()
        .find(|k| k.code() == code)
    }

    /// The number scripts use.
    pub fn code(self) -> i64 {
        self as i64
    }

    /// Alias of a new object of this kind.
    pub fn alias(self) -> &'static str {
        match self {
            Self::Plane => "Plane",
            Self::Disc => "Disc",
            Self::Cuboid => "Cuboid",
            Self::Spheroid => "Sphere",
            Self::Cylinder => "Cylinder",
            Self::Cone => "Cone",
            Self::Heightfield => "heightfield",
            Self::Capsule => "Capsule",
        }
    }

    /// Whether the mesh of this kind is a convex solid.
    pub fn is_convex(self) -> bool {
        !matches!(self, Self::Plane | Self::Disc | Self::Heightfield)
    }
}

/// The size that is used for the asked one: within 1e-5 to 1e5 m, a capsule thinner than long. NaN gives the
/// smallest.
pub fn clamp_size(kind: PrimitiveKind, size: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = size.map(|s| s.max(SIZES.0).min(SIZES.1));
    let widest = (z - 0.0001).max(SIZES.0);
    if kind == PrimitiveKind::Capsule {
        [x.min(widest), y.min(widest), z]
    } else {
        [x, y, z]
    }
}

/// Size of the bounding box of a primitive: flat ones have no height.
pub fn bounding_size(kind: PrimitiveKind, size: [f64; 3]) -> [f64; 3] {
    let flat = matches!(kind, PrimitiveKind::Plane | PrimitiveKind::Disc);
    if flat { [size[0], size[1], 0.0] } else { size }
}

/// Whether physics may use the analytic form: rotational solids only when round.
pub fn has_pure_size(kind: PrimitiveKind, size: [f64; 3]) -> bool {
    let round = size[0] == size[1];
    match kind {
        PrimitiveKind::Plane | PrimitiveKind::Cuboid | PrimitiveKind::Heightfield => true,
        PrimitiveKind::Spheroid => round && size[1] == size[2],
        _ => round,
    }
}

/// Mesh of a primitive of the given size (see [`clamp_size`]), with flat normals.
///
/// `open_ends` leaves the lids of a cylinder and the base of a cone away. `None` for height fields, which need heights, and for sizes
/// that are not finite.
pub fn tessellate(kind: PrimitiveKind, size: [f64; 3], open_ends: bool) -> Option<Mesh> {
    let (vertices, triangles) = match kind {
        PrimitiveKind::Plane => plane(),
        PrimitiveKind::Cuboid => cuboid(),
        PrimitiveKind::Disc => revolve(Some(0.0), &[(0.5, 0.0)], None),
        PrimitiveKind::Spheroid => revolve(Some(0.5), &sphere_rings(), Some(-0.5)),
        PrimitiveKind::Cylinder if open_ends => revolve(None, &[(0.5, 0.5), (0.5, -0.5)], None),
        PrimitiveKind::Cylinder => revolve(Some(0.5), &[(0.5, 0.5), (0.5, -0.5)], Some(-0.5)),
        PrimitiveKind::Cone if open_ends => revolve(Some(0.5), &[(0.5, -0.5)], None),
        PrimitiveKind::Cone => revolve(Some(0.5), &[(0.5, -0.5)], Some(-0.5)),
        PrimitiveKind::Capsule => revolve(Some(0.5), &capsule_rings(size), Some(-0.5)),
        PrimitiveKind::Heightfield => return None,
    };
    let extent = bounding_size(kind, size);
    let scaled = vertices.iter().map(|v| [0, 1, 2].map(|i| v[i] * extent[i]));
    Mesh::new(scaled.collect(), triangles).ok()
}

/// Mesh of a height field: `columns` x `rows` heights (m), row after row from +y to -y with x rising, square
/// cells over a `width` (m) along x, centred on x and y.
///
/// `None` unless there are 2 to 2048 columns and rows, enough finite heights, and a width of 1e-5 or more.
pub fn heightfield(columns: usize, rows: usize, width: f64, heights: &[f64]) -> Option<Mesh> {
    let sizes = 2..=2048;
    let fits = sizes.contains(&columns) && sizes.contains(&rows) && width >= SIZES.0;
    let heights = heights.get(..if fits { columns * rows } else { return None })?;
    let cell = width / (columns - 1) as f64;
    let centred = |i: usize, count: usize| cell * (i as f64 - 0.5 * (count - 1) as f64);
    let place = |(i, z): (usize, &f64)| {
        [
            centred(i % columns, columns),
            -centred(i / columns, rows),
            *z,
        ]
    };
    let cells = (0..rows - 1).flat_map(|r| (0..columns - 1).map(move |c| (r * columns + c) as u32));
    let row = columns as u32;
    let halves = cells.flat_map(|i| [[i, i + row, i + row + 1], [i, i + row + 1, i + 1]]);
    Mesh::new(
        heights.iter().enumerate().map(place).collect(),
        halves.collect(),
    )
    .ok()
}

/// Mass (kg) and diagonal of the inertia per kg (m2) that a new primitive gets for a density (kg/m3).
///
/// These are the formulas of CoppeliaSim with their flaws: a cone is nine times too heavy, a capsule some
/// 4 % too much. Zero for height fields.
pub fn creation_mass(kind: PrimitiveKind, size: [f64; 3], density: f64) -> (f64, [f64; 3]) {
    let [x, y, z] = size;
    let r = if kind == PrimitiveKind::Spheroid {
        (x + y + z) / 6.0
    } else {
        (x + y) / 4.0
    };
    let round = |volume: f64, across, along| {
        unequal(kind, size, r, (volume * density, [across, across, along]))
    };
    let rod = |length: f64| (3.0 * r * r + length * length) / 12.0;
    let disc = PI * r * r;
    match kind {
        PrimitiveKind::Plane => (
            x * y * SHEET * density,
            [y * y, x * x, x * x + y * y].map(|s| s / 12.0),
        ),
        PrimitiveKind::Cuboid => (
            x * y * z * density,
            [y * y + z * z, x * x + z * z, x * x + y * y].map(|s| s / 12.0),
        ),
        PrimitiveKind::Disc => round(disc * SHEET, r * r / 4.0, r * r / 2.0),
        PrimitiveKind::Spheroid => round(4.0 / 3.0 * disc * r, 0.4 * r * r, 0.4 * r * r),
        PrimitiveKind::Cylinder => round(disc * z, rod(z), r * r / 2.0),
        PrimitiveKind::Cone => round(3.0 * disc * z, 0.6 * (r * r / 4.0 + z * z), 0.3 * r * r),
        PrimitiveKind::Capsule => {
            let length = z - x.max(y) + 0.75 * x.max(y);
            round(disc * length, rod(length), r * r / 2.0)
        }
        PrimitiveKind::Heightfield => (0.0, [0.0; 3]),
    }
}

/// The correction for unequal radii: scaled as if the round solid were scaled to the same volume.
fn unequal(
    kind: PrimitiveKind,
    [x, y, z]: [f64; 3],
    r: f64,
    (mass, inertia): (f64, [f64; 3]),
) -> (f64, [f64; 3]) {
    let third = if kind == PrimitiveKind::Spheroid {
        z
    } else {
        2.0 * r
    };
    if x == y && x == third || r <= 0.0 {
        return (mass, inertia);
    }
    let s = libm::cbrt(x * y * third) / (2.0 * r);
    (mass * s.powi(3), inertia.map(|i| i * s * s))
}

type Parts = (Vec<[f64; 3]>, Vec<[u32; 3]>);

fn plane() -> Parts {
    let corners = vec![
        [-0.5, -0.5, 0.0],
        [0.5, -0.5, 0.0],
        [0.5, 0.5, 0.0],
        [-0.5, 0.5, 0.0],
    ];
    (corners, vec![[0, 1, 2], [0, 2, 3]])
}

/// Vertex i lies at +x, +y, +z where bit 0, 1, 2 of i is set.
fn cuboid() -> Parts {
    let corner = |i: u32| [0, 1, 2].map(|axis| f64::from(i >> axis & 1) - 0.5);
    let sides = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let halves = sides
        .iter()
        .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    ((0..8).map(corner).collect(), halves.collect())
}

/// Radius and z of the rings of a unit sphere between the poles.
fn sphere_rings() -> Vec<(f64, f64)> {
    let angles = (1..RINGS).map(|k| PI * f64::from(k) / f64::from(RINGS));
    angles
        .map(|a| (0.5 * libm::sin(a), 0.5 * libm::cos(a)))
        .collect()
}

/// The rings of a capsule in units of its size: half balls that are as high as half its largest width.
fn capsule_rings([x, y, z]: [f64; 3]) -> Vec<(f64, f64)> {
    let cap = if z > 0.0 {
        0.5 * (x.max(y) / z).min(1.0)
    } else {
        0.0
    };
    let half = RINGS / 2;
    let angles = (1..=half).map(|k| FRAC_PI_2 * f64::from(k) / f64::from(half));
    let upper: Vec<_> = angles
        .map(|a| (0.5 * libm::sin(a), 0.5 - cap * (1.0 - libm::cos(a))))
        .collect();
    let lower = upper.iter().rev().map(|(radius, z)| (*radius, -z));
    upper.iter().copied().chain(lower).collect()
}

/// Surface of revolution from top to bottom: rings of radius and z, closed towards points on the axis.
fn revolve(top: Option<f64>, rings: &[(f64, f64)], bottom: Option<f64>) -> Parts {
    let turn = |k: u32| libm::sincos(TAU * f64::from(k) / f64::from(SIDES));
    let ring = |(radius, z): &(f64, f64)| {
        let (radius, z) = (*radius, *z);
        (0..SIDES).map(move |k| [radius * turn(k).1, radius * turn(k).0, z])
    };
    let mut vertices: Vec<_> = rings.iter().flat_map(ring).collect();
    let bands = (0..rings.len() as u32 - 1)
        .flat_map(|r| (0..SIDES).map(move |k| (SIDES * r, k, (k + 1) % SIDES)));
    let quads = bands.flat_map(|(r, k, n)| {
        [
            [r + k, r + SIDES + k, r + SIDES + n],
            [r + k, r + SIDES + n, r + n],
        ]
    });
    let mut triangles: Vec<_> = quads.collect();
    let last = vertices.len() as u32 - SIDES;
    for (z, first, down) in [(top, 0, false), (bottom, last, true)] {
        let Some(z) = z else { continue };
        let tip = vertices.len() as u32;
        let side = |k: u32| (first + k, first + (k + 1) % SIDES);
        vertices.push([0.0, 0.0, z]);
        triangles.extend(
            (0..SIDES)
                .map(side)
                .map(|(a, b)| if down { [tip, b, a] } else { [tip, a, b] }),
        );
    }
    (vertices, triangles)
}

#[cfg(test)]
mod tests {
    use super::PrimitiveKind::*;
    use super::*;

    #[track_caller]
    fn close(a: &[f64], b: &[f64]) {
        assert!(
            a.len() == b.len() && a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-9),
            "{a:?} is not {b:?}"
        );
    }

    fn mesh(kind: PrimitiveKind, size: [f64; 3]) -> Mesh {
        tessellate(kind, size, false).expect("has a mesh")
    }

    #[test]
    fn meshes_have_the_counts_of_the_original() {
        let counts = |m: Mesh| (m.vertices.len(), m.triangles.len());
        let expected = [
            (Plane, (4, 2)),
            (Disc, (33, 32)),
            (Cuboid, (8, 12)),
            (Spheroid, (482, 960)),
            (Cylinder, (66, 128)),
        ];
        for (kind, count) in expected
            .into_iter()
            .chain([(Cone, (34, 64)), (Capsule, (514, 1024))])
        {
            assert_eq!(counts(mesh(kind, [1., 1., 2.])), count, "{kind:?}");
        }
        assert_eq!(
            counts(tessellate(Cylinder, [1.; 3], true).expect("has a mesh")),
            (64, 64)
        );
        assert_eq!(
            counts(tessellate(Cone, [1.; 3], true).expect("has a mesh")),
            (33, 32)
        );
    }

    #[test]
    fn meshes_fill_their_box_and_are_convex() {
        for kind in [Plane, Disc, Cuboid, Spheroid, Cylinder, Cone, Capsule] {
            let (mesh, size) = (
                mesh(kind, [0.1, 0.2, 0.5]),
                bounding_size(kind, [0.1, 0.2, 0.5]),
            );
            let (low, high) = mesh.aabb().expect("not empty");
            close(&high, &size.map(|s| 0.5 * s));
            close(&low, &size.map(|s| -0.5 * s));
            assert_eq!(mesh.is_convex(), kind.is_convex(), "{kind:?}");
        }
    }

    #[test]
    fn volumes_of_the_inscribed_meshes() {
        let volume = |kind| mesh(kind, [1.; 3]).volume();
        for (kind, expected) in [
            (Spheroid, 0.515242718),
            (Cylinder, 0.780361288),
            (Cone, 0.260120429),
        ] {
            assert!(
                (volume(kind) - expected).abs() < 1e-8,
                "{kind:?} {}",
                volume(kind)
            );
        }
        close(&[mesh(Cuboid, [0.2, 0.4, 0.6]).volume()], &[0.048]);
        assert!(
            mesh(Plane, [1.; 3])
                .normals
                .iter()
                .all(|n| *n == [0., 0., 1.])
        );
    }

    #[test]
    fn masses_of_round_solids_s1_to_s6() {
        let check = |kind, size, mass: f64, absolute: [f64; 3]| {
            let (m, j) = creation_mass(kind, size, 500.0);
            close(&[m], &[mass]);
            close(&j.map(|j| j * m), &absolute);
        };
        check(Cuboid, [0.1, 0.2, 0.3], 3.0, [0.0325, 0.025, 0.0125]);
        check(Spheroid, [0.2; 3], 2.094395102, [0.008377580410; 3]);
        check(
            Cylinder,
            [0.2, 0.2, 0.4],
            TAU,
            [0.099483767, 0.099483767, 0.031415927],
        );
        check(
            Cone,
            [0.2, 0.2, 0.3],
            14.137166941,
            [0.784612765, 0.784612765, 0.042411501],
        );
        check(
            Capsule,
            [0.2, 0.2, 0.5],
            7.068583471,
            [0.136953805, 0.136953805, 0.035342917],
        );
        check(
            Plane,
            [2., 1., 0.],
            1.0,
            [0.083333333333, 0.333333333333, 0.416666666667],
        );
    }

    #[test]
    fn masses_of_unequal_solids() {
        let check = |kind, size, mass: f64, absolute: [f64; 3]| {
            let (m, j) = creation_mass(kind, size, 500.0);
            close(&[m], &[mass]);
            close(&j.map(|j| j * m), &absolute);
        };
        check(Spheroid, [0.1, 0.2, 0.3], FRAC_PI_2, [0.005186655; 3]);
        check(
            Cylinder,
            [0.1, 0.2, 0.3],
            2.356194490,
            [0.019400116, 0.019400116, 0.006126353],
        );
        check(
            Cone,
            [0.1, 0.2, 0.3],
            7.068583471,
            [0.358391624, 0.358391624, 0.011027435],
        );
        check(
            Disc,
            [0.1, 0.2, 0.],
            0.007853982,
            [0.000010211, 0.000010211, 0.000020421],
        );
        check(
            Capsule,
            [0.1, 0.2, 0.5],
            3.534291735,
            [0.059731937, 0.059731937, 0.009189529],
        );
    }

    #[test]
    fn sizes_and_purity() {
        assert_eq!(
            clamp_size(Cuboid, [0., f64::NAN, f64::INFINITY]),
            [1e-5, 1e-5, 1e5]
        );
        assert_eq!(
            clamp_size(Capsule, [1., 0.1, 0.5]),
            [0.5 - 0.0001, 0.1, 0.5]
        );
        assert!(has_pure_size(Cylinder, [1., 1., 2.]) && !has_pure_size(Cylinder, [1., 2., 2.]));
        assert!(!has_pure_size(Spheroid, [1., 1., 2.]) && has_pure_size(Cuboid, [1., 2., 3.]));
        assert_eq!(PrimitiveKind::from_code(8), Some(Capsule));
        assert_eq!(PrimitiveKind::from_code(0), None);
        assert!(
            tessellate(Cone, [f64::NAN; 3], false).is_none()
                && tessellate(Capsule, [0.; 3], false).is_some()
        );
    }

    #[test]
    fn height_fields_start_at_plus_y() {
        let mesh = heightfield(3, 2, 2.0, &[0., 0., 0., 1., 1., 1.]).expect("valid");
        assert_eq!(
            (mesh.vertices[0], mesh.vertices[5]),
            ([-1., 0.5, 0.], [1., -0.5, 1.])
        );
        assert_eq!(mesh.triangles.len(), 4);
        assert!(mesh.normals.iter().all(|n| n[2] > 0.0));
        assert!(
            heightfield(1, 2, 2.0, &[0., 0.]).is_none()
                && heightfield(2, 2, 1.0, &[0., 0.]).is_none()
        );
        assert!(
            heightfield(2, 2, f64::NAN, &[0.; 4]).is_none()
                && heightfield(2, 2, 1.0, &[f64::NAN; 4]).is_none()
        );
    }
}
