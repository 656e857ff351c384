//! What scripts read of what was injected.

use std::fmt::Write as _;

use api_macro::api;
use geometry::Mesh;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::injections::{Injection, Injections};
use super::{ApiError, ApiFn, Cx, Result, functions, refused, unknown};
use robot_description::mjcf::{Flex, FlexForm};
use scene::shape::soft::{Soft, SoftForm};
use scene::{Data, Handle};
use script::Table;

pub(super) const FUNCTIONS: &[ApiFn] = functions![get_flexcomp_info, get_composite_info, get_info];

/// Where the nodes of a flexcomp are, or the triangles between them.
///
/// @param injectionId from addFlexcomp
/// @param what 0: positions of the nodes; 1: triangles to be drawn
/// @return info positions (three coordinates for each node) or triangles (nine for each), world, and count (along each axis); empty before the first step of the physics
#[api("simMujoco.getFlexcompInfo")]
fn get_flexcomp_info(cx: &Cx, injection_id: i64, what: i64) -> Result<Table> {
    let what = match what {
        0 => What::Positions,
        1 => What::Triangles { grow: 0.0 },
        _ => return Err(refused(format!("'what' is {what}, not 0 or 1."))),
    };
    info(cx, injection_id, |_| Ok(what))
}

/// Where the nodes of a composite are, or the triangles between them.
///
/// @param injectionId from composite
/// @param what 0: positions of the nodes; 1: their poses; 2: triangles to be drawn; 3: triangles grown by `grow`
/// @return info positions (three coordinates for each node), poses (seven numbers) or triangles (nine coordinates for each), world, and count (along each axis); empty before the first step of the physics
#[api("simMujoco.getCompositeInfo")]
fn get_composite_info(cx: &Cx, injection_id: i64, what: i64) -> Result<Table> {
    info(cx, injection_id, |injection| {
        Ok(match what {
            0 => What::Positions,
            1 => What::Poses,
            2 => What::Triangles { grow: 0.0 },
            3 => What::Triangles {
                grow: super::info::number(&injection.info, "grow")?.unwrap_or(0.0),
            },
            _ => return Err(refused(format!("'what' is {what}, not 0 to 3."))),
        })
    })
}

/// What a script asks for.
#[derive(Clone, Copy)]
enum What {
    Positions,
    Poses,
    Triangles { grow: f64 },
}

fn info(cx: &Cx, id: i64, what: impl FnOnce(&Injection) -> Result<What>) -> Result<Table> {
    let injections = cx.module_state::<Injections>();
    let injection = injections.get(id).ok_or_else(|| unknown(id))?;
    let what = what(&injection)?;
    let nothing = Table(Data::Map(Vec::new()));
    let Some((flex, handle)) = injection.made.softs.first() else {
        return Ok(nothing);
    };
    // The script may have removed the shape.
    let Ok(form) = cx.scene().soft_form(*handle) else {
        return Ok(nothing);
    };
    let count = flex.count.map(|count| count as i64);
    let read = match what {
        What::Positions => ("positions", positions(flex, &form)),
        What::Poses => ("poses", poses(flex, &form)),
        What::Triangles { grow } => ("triangles", triangles(cx, *handle, &form, grow)?),
    };
    Ok(Table(Data::map([
        (read.0, read.1.into()),
        ("count", count.into()),
    ])))
}

fn positions(flex: &Flex, form: &SoftForm) -> Vec<f64> {
    let points = flex.nodes.iter().filter_map(|node| form.points.get(*node));
    points.flatten().copied().collect()
}

/// Poses of the nodes: those of a line have x along it, others are not turned.
fn poses(flex: &Flex, form: &SoftForm) -> Vec<f64> {
    let turns = match flex.form {
        FlexForm::Line { .. } => along(&form.points),
        _ => vec![UnitQuaternion::identity(); form.points.len()],
    };
    let pose = |node: &usize| {
        let ([x, y, z], turn) = (form.points.get(*node)?, turns.get(*node)?);
        let Quaternion { coords } = turn.quaternion();
        Some([*x, *y, *z, coords.x, coords.y, coords.z, coords.w])
    };
    flex.nodes.iter().filter_map(pose).flatten().collect()
}

/// Orientations along a line, each turned from the one before as little as can be.
fn along(points: &[[f64; 3]]) -> Vec<UnitQuaternion<f64>> {
    let mut turn = UnitQuaternion::identity();
    let mut turns = Vec::new();
    for pair in points.windows(2) {
        let edge = Vector3::from(pair[1]) - Vector3::from(pair[0]);
        let before = turn * Vector3::x();
        if let Some(more) = UnitQuaternion::rotation_between(&before, &edge) {
            turn = more * turn;
        }
        turns.push(turn);
    }
    turns.push(turn);
    turns
}

/// Nine coordinates of each triangle. What is grown has two sides, at that distance from the nodes.
fn triangles(cx: &Cx, handle: Handle, form: &SoftForm, grow: f64) -> Result<Vec<f64>> {
    let soft = cx.scene().object(handle)?.soft();
    let grown = match soft {
        Some(Soft::Body(body)) if grow == 0.0 => Mesh {
            vertices: form.points.clone(),
            triangles: body.triangles,
            ..Mesh::default()
        },
        Some(Soft::Body(mut body)) => {
            body.radius = grow;
            Soft::Body(body).mesh(&form.points, &form.broken)
        }
        Some(Soft::Rope(mut rope)) => {
            rope.radius += grow;
            Soft::Rope(rope).mesh(&form.points, &form.broken)
        }
        None => return Err(ApiError::Other("the shape is not soft.".into())),
    };
    let corners = grown.triangles.as_flattened().iter();
    let vertices = corners.map(|corner| grown.vertices[*corner as usize]);
    Ok(vertices.flatten().collect())
}

/// What the model contains, as a text.
///
/// @param what 'nameAndIds': a line for each body, with the name by which `element` finds it, a tab and its handle; 'bodies': the names only
/// @return info the text
#[api("simMujoco.getInfo")]
fn get_info(cx: &Cx, what: String) -> Result<String> {
    let has_ids = match what.as_str() {
        "nameAndIds" => true,
        "bodies" => false,
        _ => return Err(refused("'what' is neither 'nameAndIds' nor 'bodies'.")),
    };
    let scene = cx.scene();
    let mut text = String::new();
    let shapes = scene.objects().filter(|object| object.shape().is_ok());
    for handle in shapes.map(scene::Object::handle) {
        text.push_str(&scene.unique_alias(handle)?);
        if has_ids {
            let _ = write!(text, "\t{}", handle.raw());
        }
        text.push('\n');
    }
    Ok(text)
}
