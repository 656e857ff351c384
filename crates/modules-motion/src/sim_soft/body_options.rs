//! What scripts say of a new cloth or volume.

use geometry::Pose;
use mesh_processing::{faces, tetrahedra};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};

use super::grids::{block, sheet};
use super::options::{
    check_names, counts, given, indices, number, numbers, positive, triples, truth, wrong,
};
use crate::{ApiError, Cx, Result};
use scene::shape::soft::body::Body;
use scene::{Data, Handle, SceneError};

/// Options of both.
const NAMES: &[&str] = &[
    "shape",
    "size",
    "count",
    "vertices",
    "pose",
    "mass",
    "density",
    "thickness",
    "young",
    "poisson",
    "damping",
    "drag",
    "friction",
    "selfContact",
    "color",
];
const CLOTH_NAMES: &[&str] = &[
    "triangles",
    "areaDensity",
    "stretchStiffness",
    "bendStiffness",
    "strength",
    "flat",
    "pressure",
];
const VOLUME_NAMES: &[&str] = &["tetrahedra", "cell"];
/// Cells along the longest side of a volume, if no size is given.
const CELLS: f64 = 8.0;

/// Vertices of a shape nearer than this are one, metres.
const SAME_PLACE: f64 = 1e-7;

/// A cloth or volume that is to be made.
pub(super) struct Described {
    pub body: Body,
    /// Of the frame in which its points are.
    pub pose: Pose,
    /// Kilograms, of all.
    pub mass: f64,
    pub friction: f64,
    pub colour: [f32; 3],
}

/// Where the points are, and what they are joined to.
#[derive(Default)]
struct Mesh {
    pose: Pose,
    points: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    tetrahedra: Vec<[u32; 4]>,
    /// Whether it was made as a rectangle.
    is_flat: bool,
}

impl Mesh {
    /// Area or volume.
    fn extent(&self) -> f64 {
        let body = Body {
            points: self.points.clone(),
            triangles: self.triangles.clone(),
            tetrahedra: self.tetrahedra.clone(),
            ..Body::default()
        };
        body.extent()
    }
}

/// The cloth that a table of options describes.
pub(super) fn cloth(cx: &Cx, options: &Data) -> Result<Described> {
    check_names(options, &[NAMES, CLOTH_NAMES].concat())?;
    let mesh = cloth_mesh(cx, options)?;
    let thickness = positive(options, "thickness", 1e-3)?;
    let poisson = number(options, "poisson", 0.3)?;
    let young = positive(options, "young", 1e6)?;
    let plane = young * thickness / (1.0 - poisson * poisson);
    let of_density = positive(options, "density", 300.0)? * thickness;
    let of_area = positive(options, "areaDensity", of_density)?;
    let area = mesh.extent();
    let stretch = positive(options, "stretchStiffness", plane)?;
    let body = Body {
        radius: 0.5 * thickness,
        density: density(options, of_area, area)?,
        stretch,
        bend: number(
            options,
            "bendStiffness",
            plane * thickness * thickness / 12.0,
        )?,
        poisson,
        damping: number(options, "damping", 0.01)?,
        drag: number(options, "drag", 0.3)?,
        strength: positive(options, "strength", f64::INFINITY)?,
        flat: truth(options, "flat", mesh.is_flat)?,
        pressure: pressure(options)?,
        touches_itself: truth(options, "selfContact", false)?,
        ..Body::default()
    };
    let mass = body.density * area;
    finished(options, body, mesh, mass)
}

/// Mass by extent: as given, or as the mass of all says.
fn density(options: &Data, given_density: f64, extent: f64) -> Result<f64> {
    match given(options, "mass") {
        Some(_) => Ok(positive(options, "mass", 0.0)? / extent),
        None => Ok(given_density),
    }
}

fn pressure(options: &Data) -> Result<Option<f64>> {
    let Some(value) = given(options, "pressure") else {
        return Ok(None);
    };
    let value = value.as_f64().filter(|x| x.is_finite() && *x > -1e5);
    Ok(Some(value.ok_or_else(|| wrong("pressure"))?))
}

/// The volume that a table of options describes.
pub(super) fn volume(cx: &Cx, options: &Data) -> Result<Described> {
    check_names(options, &[NAMES, VOLUME_NAMES].concat())?;
    let mesh = volume_mesh(cx, options)?;
    let extent = mesh.extent();
    let of_density = positive(options, "density", 1000.0)?;
    let body = Body {
        radius: 0.5 * number(options, "thickness", 2e-3)?,
        density: density(options, of_density, extent)?,
        young: positive(options, "young", 1e5)?,
        poisson: number(options, "poisson", 0.4)?,
        damping: number(options, "damping", 5e-3)?,
        drag: number(options, "drag", 0.1)?,
        strength: f64::INFINITY,
        touches_itself: truth(options, "selfContact", false)?,
        ..Body::default()
    };
    let mass = body.density * extent;
    finished(options, body, mesh, mass)
}

fn finished(options: &Data, body: Body, mesh: Mesh, mass: f64) -> Result<Described> {
    let body = Body {
        points: mesh.points,
        triangles: mesh.triangles,
        tetrahedra: mesh.tetrahedra,
        ..body
    };
    if let Some(fault) = body.fault() {
        return Err(ApiError::Other(format!(
            "these options describe no cloth or volume: {fault}."
        )));
    }
    let colour = numbers::<3>(options, "color")?.unwrap_or([0.7, 0.35, 0.25]);
    Ok(Described {
        body,
        pose: mesh.pose,
        mass,
        friction: number(options, "friction", 0.7)?.clamp(0.0, 100.0),
        colour: colour.map(|part| part as f32),
    })
}

fn cloth_mesh(cx: &Cx, options: &Data) -> Result<Mesh> {
    let size = numbers::<2>(options, "size")?;
    let listed = triples(options, "vertices")?;
    match (size, listed, given(options, "shape")) {
        (Some(size), None, None) => {
            let count = counts::<2>(options, "count")?.unwrap_or([10, 10]);
            let (points, triangles) = sheet(size, count);
            Ok(Mesh {
                pose: pose(options)?,
                points,
                triangles,
                is_flat: true,
                ..Mesh::default()
            })
        }
        (None, Some(points), None) => Ok(Mesh {
            pose: pose(options)?,
            points,
            triangles: indices(options, "triangles")?.ok_or_else(|| wrong("triangles"))?,
            ..Mesh::default()
        }),
        (None, None, Some(shape)) => of_shape(cx, shape),
        _ => Err(ApiError::Other(
            "a cloth needs 'size', or 'vertices' and 'triangles', or 'shape'.".into(),
        )),
    }
}

fn volume_mesh(cx: &Cx, options: &Data) -> Result<Mesh> {
    let size = numbers::<3>(options, "size")?;
    let listed = triples(options, "vertices")?;
    let mut mesh = match (size, listed, given(options, "shape")) {
        (Some(size), None, None) => {
            let count = counts::<3>(options, "count")?.unwrap_or([4, 4, 4]);
            let (points, tetrahedra) = block(size, count);
            Mesh {
                pose: pose(options)?,
                points,
                tetrahedra,
                ..Mesh::default()
            }
        }
        (None, Some(points), None) => Mesh {
            pose: pose(options)?,
            points,
            tetrahedra: indices(options, "tetrahedra")?.ok_or_else(|| wrong("tetrahedra"))?,
            ..Mesh::default()
        },
        (None, None, Some(shape)) => filled(of_shape(cx, shape)?, options)?,
        _ => {
            return Err(ApiError::Other(
                "a volume needs 'size', or 'vertices' and 'tetrahedra', or 'shape'.".into(),
            ));
        }
    };
    let count = mesh.points.len();
    if mesh
        .tetrahedra
        .as_flattened()
        .iter()
        .any(|index| *index as usize >= count)
    {
        return Err(wrong("tetrahedra"));
    }
    mesh.triangles = faces(&mesh.tetrahedra);
    Ok(mesh)
}

/// Fills a closed mesh.
fn filled(mesh: Mesh, options: &Data) -> Result<Mesh> {
    let points = || mesh.points.iter().map(|point| Vector3::from(*point));
    let low = points().reduce(|a, b| a.inf(&b)).unwrap_or_default();
    let high = points().reduce(|a, b| a.sup(&b)).unwrap_or_default();
    let cell = positive(options, "cell", (high - low).max() / CELLS)?;
    let (points, tetrahedra) =
        tetrahedra(&mesh.points, &mesh.triangles, cell).map_err(ApiError::Other)?;
    Ok(Mesh {
        pose: mesh.pose,
        points,
        tetrahedra,
        ..Mesh::default()
    })
}

/// The mesh of a shape, with its frame; vertices at the same place are one.
fn of_shape(cx: &Cx, shape: &Data) -> Result<Mesh> {
    let Data::Int(raw) = shape else {
        return Err(wrong("shape"));
    };
    let handle = Handle::from_raw(*raw).ok_or(SceneError::NoSuchObject)?;
    let mut mesh = cx.scene().object(handle)?.shape()?.mesh();
    mesh.merge_duplicates(SAME_PLACE);
    Ok(Mesh {
        pose: cx.scene().world_pose(handle)?,
        points: mesh.vertices,
        triangles: mesh.triangles,
        ..Mesh::default()
    })
}

fn pose(options: &Data) -> Result<Pose> {
    let Some([x, y, z, i, j, k, w]) = numbers::<7>(options, "pose")? else {
        return Ok(Pose::identity());
    };
    let rotation = UnitQuaternion::try_new(Quaternion::new(w, i, j, k), 1e-9);
    let rotation = rotation.ok_or_else(|| wrong("pose"))?;
    Ok(Isometry3::from_parts(Translation3::new(x, y, z), rotation))
}
