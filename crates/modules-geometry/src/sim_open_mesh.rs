//! `simOpenMesh`: shapes with fewer triangles (spec: import 6).

use api_macro::api;
use mesh_processing::Target;

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use scene::shape::Shape;
use scene::{Data, Handle, Key, Kind, SceneError};
use script::Table;

/// The module `simOpenMesh`.
pub static MODULE: Module = Module {
    about: "Shapes with fewer triangles.",
    functions: &[("Decimation", FUNCTIONS)],
    reference: "getDecimated\tDecimation\tdeprecated\t\n",
    ..Module::new("simOpenMesh")
};

const FUNCTIONS: &[ApiFn] = functions![decimate, get_decimated_shape];

/// The fields of the parameters.
const FIELDS: [&str; 4] = ["percentage", "triangles", "vertices", "error"];

/// A copy of a shape with fewer triangles: edges are collapsed, those first that change the surface least.
///
/// Closed meshes stay closed and borders where they are; textures are lost.
///
/// @param inputShape the shape, which stays as it is
/// @param params percentage (0.5: how many of the triangles remain, 0 to 1), triangles or vertices (how many remain), error (how far the surface may be
/// moved, metres: edges beyond that stay)
/// @return decimatedShape
#[api("simOpenMesh.decimate")]
fn decimate(
    cx: &mut Cx,
    input_shape: Handle,
    #[default(Table(Data::Nil))] params: Table,
) -> Result<Handle> {
    check_fields(&params.0)?;
    let triangles = triangles(cx, input_shape)?;
    let error = number(&params.0, "error")?;
    let (most_triangles, most_vertices) = (
        number(&params.0, "triangles")?,
        number(&params.0, "vertices")?,
    );
    let share = match number(&params.0, "percentage")? {
        Some(share) => share_of(triangles, share)?,
        // Without a percentage, the other limits decide; without any, half of the triangles stay.
        None if most_triangles.or(most_vertices).is_some() => usize::MAX,
        None if error.is_some() => 0,
        None => share_of(triangles, 0.5)?,
    };
    let target = Target {
        triangles: most_triangles.map_or(share, |most| share.min(most as usize)),
        vertices: most_vertices.map_or(usize::MAX, |most| most as usize),
        largest_error: error.unwrap_or(f64::INFINITY),
    };
    add_decimated(cx, input_shape, target)
}

/// A copy of a shape with fewer triangles.
///
/// @param shapeHandle the shape, which stays as it is
/// @param prop how many of the triangles remain, 0 to 1
/// @return decimatedShape
#[api("simOpenMesh.getDecimatedShape")]
fn get_decimated_shape(cx: &mut Cx, shape_handle: Handle, prop: f64) -> Result<Handle> {
    let triangles = share_of(triangles(cx, shape_handle)?, prop)?;
    add_decimated(
        cx,
        shape_handle,
        Target {
            triangles,
            ..Target::default()
        },
    )
}

fn add_decimated(cx: &mut Cx, original: Handle, target: Target) -> Result<Handle> {
    let (shape, alias, pose) = {
        let scene = cx.scene();
        let object = scene.object(original)?;
        (
            object.shape()?.decimated(target)?,
            object.alias().to_owned(),
            scene.world_pose(original)?,
        )
    };
    let handle = cx.add_object(&alias, Kind::Shape(Box::new(shape)))?;
    cx.scene_mut().set_world_pose(handle, pose)?;
    Ok(handle)
}

fn triangles(cx: &Cx, shape: Handle) -> Result<usize> {
    let count = |shape: &Shape| {
        shape
            .parts
            .iter()
            .map(|part| part.mesh.triangles.len())
            .sum()
    };
    Ok(count(cx.scene().object(shape)?.shape()?))
}

fn share_of(triangles: usize, share: f64) -> Result<usize> {
    if !(0.0..=1.0).contains(&share) {
        return Err(invalid("percentage"));
    }
    Ok((triangles as f64 * share).ceil() as usize)
}

/// A field of another name is a mistake.
fn check_fields(params: &Data) -> Result<()> {
    let Data::Map(entries) = params else {
        return Ok(());
    };
    let is_known = |key: &Key| matches!(key, Key::Text(name) if FIELDS.iter().any(|known| known.as_bytes() == name));
    match entries.iter().find(|(key, _)| !is_known(key)) {
        None => Ok(()),
        Some((key, _)) => Err(refused(&format!(
            "unknown field '{}' (known: {}).",
            name_of(key),
            FIELDS.join(", ")
        ))),
    }
}

fn name_of(key: &Key) -> String {
    match key {
        Key::Text(name) => String::from_utf8_lossy(name).into_owned(),
        other => format!("{other:?}"),
    }
}

fn number(params: &Data, name: &str) -> Result<Option<f64>> {
    match params.field(name) {
        None | Some(Data::Nil) => Ok(None),
        Some(value) => value
            .as_f64()
            .filter(|x| x.is_finite() && *x >= 0.0)
            .map(Some)
            .ok_or_else(|| invalid(name)),
    }
}

fn invalid(field: &str) -> ApiError {
    refused(&format!("invalid '{field}' field."))
}

fn refused(why: &str) -> ApiError {
    SceneError::Refused(why.into()).into()
}
