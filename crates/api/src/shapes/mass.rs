//! `sim.*`: mass, centre of mass, inertia and material of shapes.

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use scene::Handle;
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_shape_mass,
    set_shape_mass,
    get_shape_inertia,
    set_shape_inertia,
    compute_mass_and_inertia,
    set_shape_material,
];

/// Mass of a shape.
///
/// @param shapeHandle the shape
/// @return mass kg
#[api("sim.getShapeMass")]
fn get_shape_mass(cx: &Cx, shape_handle: Handle) -> Result<f64> {
    Ok(cx.scene().object(shape_handle)?.shape()?.mass.mass)
}

/// Changes the mass of a shape; its inertia changes in proportion.
///
/// @param shapeHandle the shape
/// @param mass kg
#[api("sim.setShapeMass")]
fn set_shape_mass(cx: &mut Cx, shape_handle: Handle, mass: f64) -> Result<()> {
    Ok(cx.scene_mut().reshape(shape_handle, |shape| {
        shape.mass.set_mass(mass);
        Ok(())
    })?)
}

/// Inertia and centre of mass of a shape.
///
/// @param shapeHandle the shape
/// @return inertiaMatrix kg m2, about the centre of mass, along the axes of the shape
/// @return comMatrix position of the centre of mass in the shape's frame, not rotated
#[api("sim.getShapeInertia")]
fn get_shape_inertia(cx: &Cx, shape_handle: Handle) -> Result<(Vec<f64>, [f64; 12])> {
    let mass = cx.scene().object(shape_handle)?.shape()?.mass;
    Ok((mass.absolute_inertia().to_vec(), mass.com_matrix()))
}

/// Changes inertia and centre of mass of a shape. Set the mass first.
///
/// @param shapeHandle the shape
/// @param inertiaMatrix kg m2, about the centre of mass, along the axes of comMatrix; the upper triangle counts
/// @param comMatrix frame at the centre of mass, in the shape's frame
#[api("sim.setShapeInertia")]
fn set_shape_inertia(
    cx: &mut Cx,
    shape_handle: Handle,
    inertia_matrix: [f64; 9],
    com_matrix: [f64; 12],
) -> Result<()> {
    Ok(cx.scene_mut().reshape(shape_handle, |shape| {
        shape
            .mass
            .set_absolute_inertia(&inertia_matrix, &com_matrix);
        Ok(())
    })?)
}

/// Sets mass, inertia and centre of mass of a shape as if it was solid.
///
/// @param shapeHandle the shape
/// @param density kg/m3
/// @return result 1, or 0 when the shape has no volume
#[api("sim.computeMassAndInertia")]
fn compute_mass_and_inertia(cx: &mut Cx, shape_handle: Handle, density: f64) -> Result<i64> {
    Ok(i64::from(
        cx.scene_mut().reshape(shape_handle, |shape| {
            Ok(shape.set_mass_from_density(density))
        })?,
    ))
}

/// Assigns a preset material to a shape, or the material of another shape.
///
/// @param shapeHandle the shape
/// @param materialIdOrShapeHandle sim.dynmat_* or a shape
/// @return result -1 for a preset, 1 for another shape
#[api("sim.setShapeMaterial")]
fn set_shape_material(
    cx: &mut Cx,
    shape_handle: Handle,
    material_id_or_shape_handle: Number,
) -> Result<i64> {
    let copied = cx
        .scene_mut()
        .set_shape_material(shape_handle, material_id_or_shape_handle.0)?;
    Ok(if copied { 1 } else { -1 })
}
