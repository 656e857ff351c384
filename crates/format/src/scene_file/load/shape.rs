//! Shapes: geometry in its two layouts, mass, material, appearance (spec: scene-files 7.1).

use std::rc::Rc;

use geometry::BoundingBox;
use geometry::MassProperties;
use geometry::Mesh;
use geometry::PrimitiveKind;
use nalgebra::Matrix3;

use super::mesh::is_nearly_convex;
use super::sensors::colour;
use super::{Context, material, texture};
use crate::ttt::PositionFirst;
use crate::ttt::chunks::{MeshData, MeshNode, Shape as Chunk, ShapeGeometry};
use crate::ttt::tree::{Mesh as FileMesh, MeshTree};
use scene::Pose;
use scene::appearance::texture_mapping::TextureMapping;
use scene::shape::{
    Appearance, HeightField, Part, Primitive, RespondableMask, Shape, ShapeDynamics, Velocity,
};

/// Smallest moment of inertia per kilogram (m2) that counts.
const MIN_MOMENT: f64 = 1e-8;
/// The flag of a node whose meshes were found convex, before 4.5.1.
const CONVEX: u8 = 0x4;

/// # Errors
/// In words, when the geometry is missing or damaged.
pub(super) fn shape(context: &mut Context<'_>, chunk: &Chunk) -> Result<Shape, String> {
    let geometry = chunk.geometry.as_ref().ok_or("a shape has no geometry")?;
    let (root, parts) = parts(context, geometry)?;
    let bounding_box = match (root.box_frame.and_then(|frame| frame.pose()), root.box_size) {
        (Some(pose), Some(size)) => BoundingBox { size, pose },
        _ => box_around(&parts).ok_or("a shape has no triangles")?,
    };
    let dynamics = dynamics(chunk);
    let mut shape = Shape {
        mass: mass(root, &Pose::identity()),
        material: material::of_shape(context, chunk, root, dynamics.is_static),
        bounding_box,
        dynamics,
        velocity: Velocity::default(),
        force: [0.0; 3],
        torque: [0.0; 3],
        soft_form: None,
        parts,
    };
    if let [part] = shape.parts.as_mut_slice() {
        part.mass = shape.mass.reexpressed(&part.pose.inverse());
    }
    Ok(shape)
}

fn parts<'a>(
    context: &mut Context<'_>,
    geometry: &'a ShapeGeometry,
) -> Result<(&'a MeshNode, Vec<Part>), String> {
    if let Some(mesh) = &geometry.mesh {
        return Ok((
            &mesh.node,
            vec![part(context, mesh, &Pose::identity(), true)?],
        ));
    }
    let group = geometry
        .group
        .as_ref()
        .ok_or("a shape has neither a mesh nor a group of meshes")?;
    let mut parts = Vec::new();
    collect(context, group, &Pose::identity(), &mut parts)?;
    if parts.is_empty() {
        return Err("a compound shape has no meshes".into());
    }
    Ok((group, parts))
}

/// The meshes of a group, whose frame in the shape is `frame`.
fn collect(
    context: &mut Context<'_>,
    group: &MeshNode,
    frame: &Pose,
    parts: &mut Vec<Part>,
) -> Result<(), String> {
    for (number, child) in (0..).zip(&group.children) {
        match child {
            MeshTree::Mesh(mesh) => {
                let frame = node_frame(&mesh.node, frame);
                parts.push(part(context, mesh, &frame, false)?);
            }
            MeshTree::Group(inner) => {
                let first = parts.len();
                collect(context, inner, &node_frame(inner, frame), parts)?;
                // A mesh that is alone in its group is no group.
                if parts.len() > first + 1 {
                    parts[first..]
                        .iter_mut()
                        .for_each(|part| part.group.insert(0, number));
                }
            }
        }
    }
    Ok(())
}

/// The frame of a node in the shape: relative to its parent since 4.5.1, cumulative before.
fn node_frame(node: &MeshNode, parent: &Pose) -> Pose {
    match (node.frame, node.old_frame) {
        (Some(frame), _) => parent * frame.pose().unwrap_or_default(),
        (None, Some(frame)) => frame.pose().unwrap_or_default(),
        (None, None) => *parent,
    }
}

/// One mesh in a node whose frame in the shape is `frame`. A primitive lies in a frame of its own, centred; a mesh in that of the node.
fn part(
    context: &mut Context<'_>,
    mesh: &FileMesh,
    frame: &Pose,
    simple: bool,
) -> Result<Part, String> {
    let (node, data) = (&mesh.node, &mesh.data);
    let vertices = vertex_frame(node, data, frame);
    let primitive = primitive(data);
    let centred = primitive
        .as_ref()
        .is_some_and(|p| p.kind != PrimitiveKind::Heightfield);
    let triangles = context
        .meshes
        .mesh(data, if centred { &IDENTITY } else { &vertices })?;
    let (triangles, convex) = convexity(node, data, triangles);
    let corners = 6 * triangles.triangles.len();
    let fits = |t: &TextureMapping| t.coordinates.is_empty() || t.coordinates.len() == corners;
    let texture = data
        .texture
        .as_ref()
        .and_then(texture::mapping)
        .filter(fits)
        .map(Box::new);
    let in_node = if centred { vertices } else { Pose::identity() };
    Ok(Part {
        uid: 0,
        mesh: triangles,
        pose: if simple { in_node } else { frame * in_node },
        primitive,
        convex,
        mass: mass(node, frame).reexpressed(&in_node.inverse()),
        alias: String::new(),
        group: Vec::new(),
        appearance: appearance(data),
        texture,
    })
}

static IDENTITY: heap::Lazy<Pose> = heap::Lazy::new(Pose::identity);

/// The frame of the stored vertices in the node.
fn vertex_frame(node: &MeshNode, data: &MeshData, frame: &Pose) -> Pose {
    let pose = |frame: Option<PositionFirst>| frame.and_then(|frame| frame.pose());
    if node.frame.is_some() {
        pose(node.box_frame).unwrap_or_default()
    } else {
        frame.inverse() * pose(data.old_vertex_frame).unwrap_or_default()
    }
}

/// Mass properties in the frame of the node, which is `frame` in the shape.
fn mass(node: &MeshNode, frame: &Pose) -> MassProperties {
    let mut properties = MassProperties::default();
    properties.set_mass(
        node.mass
            .filter(|mass| mass.is_finite() && *mass > 0.0)
            .unwrap_or(0.001),
    );
    let (com, inertia) = match (node.inertia, node.centre_of_mass, &node.old_inertia) {
        (Some(inertia), Some(com), _) => (com, Matrix3::from_row_slice(&inertia)),
        (_, _, Some((axes, moments))) => {
            // Old files say it in the frame of the shape, along the principal axes.
            let axes = frame.inverse() * axes.pose().unwrap_or_default();
            let turn = axes.rotation.to_rotation_matrix().into_inner();
            (
                axes.translation.vector.into(),
                turn * Matrix3::from_diagonal(&(*moments).into()) * turn.transpose(),
            )
        }
        _ => return properties,
    };
    if com
        .iter()
        .chain(inertia.iter())
        .all(|number| number.is_finite())
    {
        (properties.com, properties.inertia) = (com, lifted(inertia));
    }
    properties
}

/// Symmetric, and no moment below the smallest.
fn lifted(inertia: Matrix3<f64>) -> Matrix3<f64> {
    let mut inertia = 0.5 * (inertia + inertia.transpose());
    (0..3).for_each(|i| inertia[(i, i)] = inertia[(i, i)].max(MIN_MOMENT));
    inertia
}

fn primitive(data: &MeshData) -> Option<Primitive> {
    let (kind, size) = data.primitive?;
    let size = size.map(f64::abs);
    if !size.iter().all(|side| side.is_finite()) {
        return None;
    }
    let kind = PrimitiveKind::from_code(i64::from(kind))?;
    let heights = match &data.heightfield {
        Some(field)
            if kind == PrimitiveKind::Heightfield && field.columns > 1 && field.rows > 1 =>
        {
            Some(Rc::new(HeightField {
                columns: field.columns,
                rows: field.rows,
                heights: field.heights.clone(),
            }))
        }
        _ if kind == PrimitiveKind::Heightfield => return None,
        _ => None,
    };
    Some(Primitive {
        kind,
        size: round(kind, size),
        heights,
    })
}

/// Old files leave the second diameter of round bodies out.
fn round(kind: PrimitiveKind, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let is_round = matches!(
        kind,
        PrimitiveKind::Cylinder
            | PrimitiveKind::Cone
            | PrimitiveKind::Capsule
            | PrimitiveKind::Disc
    );
    [x, if is_round && y == 0.0 { x } else { y }, z]
}

/// Whether physics takes the mesh for its hull. Before 4.5.1 that was tested at load; what should have been convex and is not becomes its hull.
fn convexity(node: &MeshNode, data: &MeshData, mesh: Rc<Mesh>) -> (Rc<Mesh>, bool) {
    if let Some(switches) = data.switches_2 {
        return (mesh, switches & 1 == 1);
    }
    let claimed = node.switches.unwrap_or(0) & CONVEX != 0;
    if is_nearly_convex(&mesh) {
        return (mesh, true);
    }
    let hull = if claimed {
        Mesh::convex_hull(&mesh.vertices)
    } else {
        None
    };
    hull.map_or((mesh, false), |hull| (Rc::new(hull), true))
}

/// The box along the axes of the frame: of the mesh where there is one, of the shape where there are several.
fn box_around(parts: &[Part]) -> Option<BoundingBox> {
    let upright = nalgebra::UnitQuaternion::identity();
    if let [part] = parts {
        let own = part.mesh.bounding_box(&upright)?;
        return Some(BoundingBox {
            size: own.size,
            pose: part.pose * own.pose,
        });
    }
    let mut all = Mesh::default();
    parts
        .iter()
        .for_each(|part| all.append(&part.mesh, &part.pose));
    all.bounding_box(&upright)
}

fn appearance(data: &MeshData) -> Appearance {
    let mut appearance = Appearance::new([1.0; 3]);
    if let Some(chunk) = &data.colour {
        appearance.colour = colour(chunk, appearance.colour, false);
        appearance.colour_extension = chunk
            .extension_string
            .as_ref()
            .map(crate::ttt::Text::decode)
            .unwrap_or_default();
        appearance.colour_name = chunk
            .name
            .as_ref()
            .map(crate::ttt::Text::decode)
            .unwrap_or_default();
    }
    let switches = data.switches.unwrap_or(0);
    (appearance.edges, appearance.culling, appearance.wireframe) =
        (switches & 1 != 0, switches & 2 != 0, switches & 4 != 0);
    appearance.edge_borders_hidden = switches & 0x80 != 0;
    if let Some((angle, _)) = data.shading {
        (appearance.shading_angle, appearance.edge_angle) = (angle, angle);
    }
    appearance.edge_angle = data.edge_threshold_angle.unwrap_or(appearance.edge_angle);
    appearance
}

fn dynamics(chunk: &Chunk) -> ShapeDynamics {
    let first = chunk.switches.unwrap_or(0);
    let second = chunk.switches_3.or(chunk.switches_2).unwrap_or(0);
    let [lx, ly, lz, ax, ay, az] = chunk.initial_velocity.unwrap_or_default();
    ShapeDynamics {
        is_static: first & 0x80 == 0,
        kinematic: first & 0x2 == 0,
        start_asleep: first & 0x40 != 0,
        respondable: second & 0x1 != 0,
        dynamic_when_parented: second & 0x20 != 0,
        respondable_mask: chunk
            .respondable_mask
            .map_or(RespondableMask::ALL, |mask| RespondableMask(mask.into())),
        respondable_suspend_count: 0,
        initial_velocity: Velocity {
            linear: [lx, ly, lz],
            angular: [ax, ay, az],
        },
    }
}
