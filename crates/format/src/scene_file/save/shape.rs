//! Shapes: one mesh, or a group of meshes, each in the frame of its box.

use geometry::MassProperties;
use geometry::PrimitiveKind;

use super::{Context, colour, texture};
use crate::ttt::chunks::{
    Material as MaterialChunk, MeshData, MeshNode, Shape as Chunk, ShapeGeometry,
};
use crate::ttt::tree::{Mesh as FileMesh, MeshTree};
use crate::ttt::{EngineBlock, Heights};
use scene::Pose;
use scene::parameters::engine::Engine;
use scene::parameters::engine_blocks::EngineValues;
use scene::shape::reshape::box_of;
use scene::shape::{Appearance, Material, Part, Primitive, Shape, ShapeDynamics};

const CONVEX: u8 = 0x4;
const CONVEXITY_KNOWN: u8 = 0x20;
/// Groups within groups; readers have an end somewhere, so deeper ones are written as one.
const MAX_GROUP_DEPTH: usize = 50;

/// A mesh or group in a shape: which node it is, and where its vertices are.
struct Place {
    name: String,
    /// Of the group it is in, in the shape.
    group: Pose,
    /// Of the node in the shape.
    node: Pose,
    /// Of the vertices in the node.
    vertices: Pose,
    mass: MassProperties,
}

pub(super) fn shape(context: &mut Context<'_>, shape: &Shape) -> Chunk {
    let geometry = match shape.parts.as_slice() {
        [part] => ShapeGeometry {
            mesh: Some(simple(context, shape, part)),
            ..ShapeGeometry::default()
        },
        parts => ShapeGeometry {
            group: Some(group(context, shape, parts)),
            ..ShapeGeometry::default()
        },
    };
    let dynamics = &shape.dynamics;
    let [linear, angular] = [
        dynamics.initial_velocity.linear,
        dynamics.initial_velocity.angular,
    ];
    Chunk {
        geometry: Some(geometry),
        material: Some(material(&shape.material)),
        respondable_mask: Some(dynamics.respondable_mask.bits()),
        initial_velocity: Some([
            linear[0], linear[1], linear[2], angular[0], angular[1], angular[2],
        ]),
        switches: Some(switches(dynamics)),
        switches_3: Some(
            u8::from(dynamics.respondable) | u8::from(dynamics.dynamic_when_parented) << 5,
        ),
        ..Chunk::default()
    }
}

fn switches(dynamics: &ShapeDynamics) -> u8 {
    let bits = [
        (!dynamics.kinematic, 0x2),
        (dynamics.start_asleep, 0x40),
        (!dynamics.is_static, 0x80),
    ];
    bits.iter()
        .filter(|(on, _)| *on)
        .fold(0, |bits, (_, bit)| bits | bit)
}

/// The node of a simple shape is its frame. A primitive is centred in its box; a mesh is written in the box of the shape.
fn simple(context: &mut Context<'_>, shape: &Shape, part: &Part) -> FileMesh {
    let vertices = if is_centred(part) {
        part.pose
    } else {
        shape.bounding_box.pose
    };
    let place = Place {
        vertices,
        ..Place::root(shape)
    };
    let mut mesh = mesh(context, part, place);
    mesh.node.box_size = Some(shape.bounding_box.size);
    mesh
}

fn group(context: &mut Context<'_>, shape: &Shape, parts: &[Part]) -> MeshNode {
    let mut root = node(
        &Place::root(shape),
        shape.bounding_box.size,
        shape.is_convex(),
    );
    root.children = children(context, parts, 0, &Pose::identity(), &mut 0);
    root
}

/// The members of a group whose frame in the shape is `frame`: parts, or groups of those that are together at this depth.
/// `named` counts the nodes that have a name.
fn children(
    context: &mut Context<'_>,
    parts: &[Part],
    depth: usize,
    frame: &Pose,
    named: &mut usize,
) -> Vec<MeshTree> {
    let together = |a: &Part, b: &Part| {
        depth < MAX_GROUP_DEPTH
            && a.group
                .get(depth)
                .is_some_and(|group| b.group.get(depth) == Some(group))
    };
    let members = parts.chunk_by(together).map(|member| {
        *named += 1;
        let name = format!("sub__{named}");
        match member {
            [part] => {
                let vertices = if is_centred(part) {
                    Pose::identity()
                } else {
                    centre(part)
                };
                let place = Place {
                    name,
                    group: *frame,
                    node: part.pose,
                    vertices,
                    mass: part.mass,
                };
                MeshTree::Mesh(Box::new(mesh(context, part, place)))
            }
            parts => MeshTree::Group(Box::new(subgroup(
                context,
                parts,
                (name, depth + 1),
                frame,
                named,
            ))),
        }
    });
    members.collect()
}

/// A group in a group. Its frame is that of its last part.
fn subgroup(
    context: &mut Context<'_>,
    parts: &[Part],
    (name, depth): (String, usize),
    outer: &Pose,
    named: &mut usize,
) -> MeshNode {
    let frame = parts.last().map_or(*outer, |part| part.pose);
    let own: Vec<Part> = parts
        .iter()
        .map(|part| Part {
            pose: frame.inverse() * part.pose,
            ..part.clone()
        })
        .collect();
    let masses: Vec<_> = own.iter().map(|part| (part.pose, part.mass)).collect();
    let (vertices, size) =
        box_of(&own).map_or_else(Default::default, |around| (around.pose, around.size));
    let place = Place {
        name,
        group: *outer,
        node: frame,
        vertices,
        mass: MassProperties::combine(&masses).unwrap_or_default(),
    };
    let mut group = node(&place, size, own.iter().all(|part| part.convex));
    group.children = children(context, parts, depth, &frame, named);
    group
}

impl Place {
    fn root(shape: &Shape) -> Self {
        let name = "sub__0".into();
        let node = Pose::identity();
        Self {
            name,
            group: node,
            node,
            vertices: shape.bounding_box.pose,
            mass: shape.mass,
        }
    }
}

/// Whether the vertices lie around the origin of the part's frame because the primitive does.
fn is_centred(part: &Part) -> bool {
    part.primitive
        .as_ref()
        .is_some_and(|primitive| primitive.kind != PrimitiveKind::Heightfield)
}

/// The middle of the vertices of a part.
fn centre(part: &Part) -> Pose {
    let (low, high) = part.mesh.aabb().unwrap_or_default();
    let [x, y, z] = std::array::from_fn(|axis| 0.5 * (low[axis] + high[axis]));
    Pose::translation(x, y, z)
}

fn mesh(context: &mut Context<'_>, part: &Part, place: Place) -> FileMesh {
    // Vertices are known in the frame of the part.
    let moved = (place.node * place.vertices).inverse() * part.pose;
    let frame = if is_identity(&moved) {
        Pose::identity()
    } else {
        moved
    };
    let written = context
        .pool
        .write(&part.mesh, &frame, part.appearance.edge_angle);
    let node = node(&place, written.size, part.convex);
    let (code, size) = part
        .primitive
        .as_ref()
        .map_or((0, [0.0; 3]), |p| (numbers::low_i32(p.kind.code()), p.size));
    let mut data = MeshData {
        primitive: Some((code, size)),
        inside_scaling: Some(0.0),
        old_vertex_frame: Some((place.node * place.vertices).into()),
        switches: Some(drawing(&part.appearance)),
        switches_2: Some(part.convex.into()),
        heightfield: Some(heights(part.primitive.as_ref())),
        texture: part
            .texture
            .as_deref()
            .map(|mapping| texture::mapping(context, mapping)),
        ..MeshData::default()
    };
    appearance(&mut data, &part.appearance);
    written.refer(&mut data);
    FileMesh { node, data }
}

/// No motion but for rounding.
fn is_identity(pose: &Pose) -> bool {
    pose.translation.vector.amax() < 1e-12 && pose.rotation.angle() < 1e-12
}

fn node(place: &Place, box_size: [f64; 3], convex: bool) -> MeshNode {
    let mass = &place.mass;
    let (axes, moments) = mass.principal_axes();
    let inertia_frame = place.node * Pose::from_parts(mass.com.into(), axes);
    MeshNode {
        name: Some(place.name.as_str().into()),
        mass: Some(mass.mass),
        old_inertia: Some((inertia_frame.into(), moments)),
        old_frame: Some(place.node.into()),
        frame: Some((place.group.inverse() * place.node).into()),
        centre_of_mass: Some(mass.com),
        inertia: Some(std::array::from_fn(|i| mass.inertia[(i / 3, i % 3)])),
        box_frame: Some(place.vertices.into()),
        box_size: Some(box_size),
        switches: Some(if convex { CONVEX } else { 0 }),
        ..MeshNode::default()
    }
}

fn drawing(appearance: &Appearance) -> u8 {
    let bits = [
        (appearance.edges, 0x1),
        (appearance.culling, 0x2),
        (appearance.wireframe, 0x4),
        (appearance.edge_borders_hidden, 0x80),
    ];
    bits.iter()
        .filter(|(on, _)| *on)
        .fold(CONVEXITY_KNOWN, |bits, (_, bit)| bits | bit)
}

fn appearance(data: &mut MeshData, appearance: &Appearance) {
    let mut chunk = colour::colour(&appearance.colour);
    chunk.name = Some(appearance.colour_name.as_str().into());
    chunk.extension_string = Some(appearance.colour_extension.as_str().into());
    data.colour = Some(chunk);
    data.shading = Some((appearance.shading_angle, 1));
    data.edge_threshold_angle = Some(appearance.edge_angle);
}

fn heights(primitive: Option<&Primitive>) -> Heights {
    let Some(field) = primitive.and_then(|primitive| primitive.heights.as_ref()) else {
        return Heights::default();
    };
    Heights {
        columns: field.columns,
        rows: field.rows,
        heights: field.heights.clone(),
    }
}

fn material(material: &Material) -> MaterialChunk {
    let [bullet, ode_values, vortex, newton, mujoco] = blocks(material);
    MaterialChunk {
        id: Some(-1),
        name: Some("".into()),
        bcv: Some(1),
        mvar: Some(0),
        vortex,
        newton,
        bullet,
        ode_values,
        mujoco,
        ..MaterialChunk::default()
    }
}

/// One block per engine.
pub(super) fn blocks(values: &impl EngineValues) -> [Option<EngineBlock>; 5] {
    Engine::ALL.map(|engine| {
        let (reals, ints) = values.engine_rows(engine);
        Some(EngineBlock { reals, ints })
    })
}
