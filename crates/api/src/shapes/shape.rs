//! `sim.*`: creating shapes, their meshes and boxes.

use api_macro::api;
use geometry::PrimitiveKind;
use geometry::pose::{pose_from_array, pose_to_array};
use geometry::{Mesh, MeshError};

use super::texture;
use crate::{ApiFn, Cx, Result, functions};
use scene::shape::options::{HeightfieldOptions, MeshOptions, PrimitiveOptions, PureShapeOptions};
use scene::shape::{Appearance, Part, Shape};
use scene::{Data, Field, Handle, Key, Kind, Scene, SceneError, SpecialFlags};
use script::{Bytes, Number};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    create_primitive_shape,
    create_pure_shape,
    create_shape,
    create_heightfield_shape,
    get_shape_mesh,
    get_shape_bb,
    get_shape_geom_info,
    get_shape_viz,
    relocate_shape_frame,
    align_shape_bb,
];

/// Vertices of a new mesh closer than this become one, metres.
const SAME_VERTEX: f64 = 1e-6;

/// A new primitive shape, centred on the world's origin: static and not respondable.
///
/// @param primitiveType sim.primitiveshape_*
/// @param sizes full extents, metres
/// @param options 1: back faces culled, 2: sharp edges, 4: open ends, 8: only a mesh, no primitive for the physics
/// @return shapeHandle the shape, -1 when there is no such primitive
#[api("sim.createPrimitiveShape")]
fn create_primitive_shape(
    cx: &mut Cx,
    primitive_type: Number,
    sizes: [f64; 3],
    #[default(0)] options: Number,
) -> Result<i64> {
    let makeable = |kind: &PrimitiveKind| *kind != PrimitiveKind::Heightfield;
    let Some(kind) = PrimitiveKind::from_code(primitive_type.0).filter(makeable) else {
        return Ok(-1);
    };
    let options = PrimitiveOptions::from_bits_retain(options.0);
    let shape = cx.scene_mut().primitive(kind, sizes, options)?;
    Ok(add(cx, kind.alias(), shape)?.raw())
}

/// A new primitive shape, as releases before 4.3 make it.
///
/// @param primitiveType 0: cuboid, 1: sphere, 2: cylinder, 3: cone
/// @param options 1: back faces culled, 2: edges visible, 4: smooth, 8: respondable, 16: static, 32: open ends
/// @param sizes full extents, metres; of a sphere the first
/// @param mass kg
/// @param precision not used
/// @return objectHandle the shape
#[api("sim.createPureShape")]
fn create_pure_shape(
    cx: &mut Cx,
    primitive_type: Number,
    options: Number,
    sizes: [f64; 3],
    mass: f64,
    #[default(None)] precision: Option<[f64; 2]>,
) -> Result<Handle> {
    let _ = precision;
    let kinds = [
        PrimitiveKind::Cuboid,
        PrimitiveKind::Spheroid,
        PrimitiveKind::Cylinder,
        PrimitiveKind::Cone,
    ];
    let kind = usize::try_from(primitive_type.0)
        .ok()
        .and_then(|i| kinds.get(i).copied());
    let kind = kind.ok_or(SceneError::InvalidArgument)?;
    let options = PureShapeOptions::from_bits_retain(options.0);
    let sizes = if kind == PrimitiveKind::Spheroid {
        [sizes[0]; 3]
    } else {
        sizes
    };
    let mut shape = cx.scene_mut().primitive(kind, sizes, options.primitive())?;
    shape.mass.set_mass(mass);
    shape.dynamics.respondable = options.contains(PureShapeOptions::RESPONDABLE);
    shape.dynamics.is_static = options.contains(PureShapeOptions::STATIC);
    add(cx, kind.alias(), shape)
}

/// A new shape from a mesh in world coordinates; its frame is the world's.
///
/// @param options 1: back faces culled, 2: edges visible, 128: keep duplicate vertices; for the texture 4: pixels are not interpolated,
/// 8: applied as a decal, 16: with opacities, 32: mirrored, 64: the bottom row is the first
/// @param shadingAngle edges sharper than this show, rad
/// @param vertices three coordinates each, metres
/// @param indices three vertices per triangle, from 0
/// @param normals nine numbers per triangle
/// @param textureCoordinates two for each index; the texture needs them
/// @param texture red, green, blue of each pixel, the top row first
/// @param textureResolution width and height
/// @return shapeHandle the shape
#[api("sim.createShape")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn create_shape(
    cx: &mut Cx,
    options: Number,
    shading_angle: f64,
    vertices: Vec<f64>,
    indices: Vec<i64>,
    #[default(None)] normals: Option<Vec<f64>>,
    #[default(None)] texture_coordinates: Option<Vec<f64>>,
    #[default(None)] texture: Option<Bytes>,
    #[default(None)] texture_resolution: Option<[f64; 2]>,
) -> Result<Handle> {
    let mut mesh = Mesh::from_flat(&vertices, &indices, normals.as_deref()).map_err(refusal)?;
    let options = MeshOptions::from_bits_retain(options.0);
    let image = texture.zip(texture_resolution);
    let texture = texture_coordinates.zip(image);
    if !options.contains(MeshOptions::KEEP_DUPLICATE_VERTICES) && texture.is_none() {
        mesh.merge_duplicates(SAME_VERTEX);
    }
    let mut appearance = shaded(Shape::mesh_appearance(), shading_angle);
    appearance.culling = options.contains(MeshOptions::CULLING);
    appearance.edges = options.contains(MeshOptions::EDGES);
    if normals.is_none() {
        mesh.compute_normals(appearance.shading_angle);
    }
    let mut shape = Shape::from_mesh(mesh, appearance)?;
    if let Some((coordinates, (pixels, size))) = texture {
        let mapping =
            texture::of_mesh(cx, options, &coordinates[..], indices.len(), pixels.0, size)?;
        shape.parts[0].texture = Some(Box::new(mapping));
    }
    add(cx, "shape", shape)
}

/// New terrain, centred on x and y: static and respondable.
///
/// @param options 1: back faces culled, 2: edges visible, 4: only a mesh for the physics, 8: not respondable
/// @param shadingAngle edges sharper than this show, rad
/// @param xPointCount columns, 2 to 2048
/// @param yPointCount rows, 2 to 2048
/// @param xSize width along x, metres; cells are square
/// @param heights metres, row after row from +y to -y
/// @return shapeHandle the shape
#[api("sim.createHeightfieldShape")]
fn create_heightfield_shape(
    cx: &mut Cx,
    options: Number,
    shading_angle: f64,
    x_point_count: Number,
    y_point_count: Number,
    x_size: f64,
    heights: Vec<f64>,
) -> Result<Handle> {
    let count = |points: Number| usize::try_from(points.0).unwrap_or(0);
    let options = HeightfieldOptions::from_bits_retain(options.0);
    let mut appearance = shaded(Shape::terrain_appearance(), shading_angle);
    appearance.culling = options.contains(HeightfieldOptions::CULLING);
    appearance.edges = options.contains(HeightfieldOptions::EDGES);
    let (columns, rows) = (count(x_point_count), count(y_point_count));
    let plain_mesh = options.contains(HeightfieldOptions::PLAIN_MESH);
    let mut shape = Shape::terrain(columns, rows, x_size, &heights, appearance, plain_mesh)?;
    shape.dynamics.respondable = !options.contains(HeightfieldOptions::NOT_RESPONDABLE);
    let handle = cx
        .scene_mut()
        .add("heightfield", Kind::Shape(Box::new(shape)))?;
    cx.scene_mut()
        .modify(handle, Field::SpecialProperty, |object| {
            object
                .special_property
                .remove(SpecialFlags::COLLIDABLE | SpecialFlags::MEASURABLE);
        })?;
    cx.notify_created(&[handle]);
    Ok(handle)
}

fn shaded(mut appearance: Appearance, shading_angle: f64) -> Appearance {
    appearance.shading_angle = if shading_angle.is_finite() {
        shading_angle
    } else {
        0.0
    };
    appearance
}

fn refusal(error: MeshError) -> SceneError {
    match error {
        MeshError::NotFinite => SceneError::InvalidData,
        other => SceneError::Refused(other.to_string()),
    }
}

fn add(cx: &mut Cx, alias: &str, shape: Shape) -> Result<Handle> {
    cx.add_object(alias, Kind::Shape(Box::new(shape)))
}

/// The mesh of a shape, in its frame; compounds as one.
///
/// @param shapeHandle the shape
/// @return vertices three coordinates each, metres
/// @return indices three vertices per triangle, from 0
/// @return normals nine numbers per triangle
#[api("sim.getShapeMesh")]
fn get_shape_mesh(cx: &Cx, shape_handle: Handle) -> Result<(Vec<f64>, Vec<i64>, Vec<f64>)> {
    let mesh = cx.scene().object(shape_handle)?.shape()?.mesh();
    Ok((
        mesh.flat_vertices(),
        mesh.flat_indices(),
        mesh.flat_normals(),
    ))
}

/// The bounding box of a shape.
///
/// @param shapeHandle the shape
/// @return size full extents, metres
/// @return pose of the box in the shape's frame
#[api("sim.getShapeBB")]
fn get_shape_bb(cx: &Cx, shape_handle: i64) -> Result<([f64; 3], [f64; 7])> {
    let shape_handle = Handle::from_raw(shape_handle).ok_or(SceneError::NoSuchObject)?;
    let bounding_box = cx.scene().object(shape_handle)?.shape()?.bounding_box;
    Ok((bounding_box.size, pose_to_array(&bounding_box.pose)))
}

/// The kind of geometry of a shape.
///
/// @param shapeHandle the shape
/// @return result 1: compound, 2: primitive for the physics, 4: convex
/// @return pureType sim.primitiveshape_*, 0 if it is none
/// @return dimensions full extents of the primitive, metres, and 0
#[api("sim.getShapeGeomInfo")]
fn get_shape_geom_info(cx: &Cx, shape_handle: Handle) -> Result<(i64, i64, [f64; 4])> {
    let scene = cx.scene();
    let shape = scene.object(shape_handle)?.shape()?;
    let mask = i64::from(shape.is_compound())
        | i64::from(shape.is_pure()) << 1
        | i64::from(shape.is_convex()) << 2;
    let primitive = match shape.parts.as_slice() {
        [part] => part.primitive.as_ref(),
        _ => None,
    };
    let (kind, [x, y, z]) = primitive.map_or((0, [0.0; 3]), |primitive| {
        (primitive.kind.code(), primitive.size)
    });
    Ok((mask, kind, [x, y, z, 0.0]))
}

/// The appearance of one mesh of a shape.
///
/// @param shapeHandle the shape
/// @param itemIndex which mesh, from 0
/// @return data vertices, indices, normals, colors, shadingAngle, transparency, options, texture; nothing past the last mesh
#[api("sim.getShapeViz")]
fn get_shape_viz(cx: &Cx, shape_handle: Handle, item_index: Number) -> Result<Option<Data>> {
    let scene = cx.scene();
    let shape = scene.object(shape_handle)?.shape()?;
    Ok(usize::try_from(item_index.0)
        .ok()
        .and_then(|index| shape.parts.get(index))
        .map(|part| viz(&scene, part)))
}

fn viz(scene: &Scene, part: &Part) -> Data {
    let mut mesh = Mesh::default();
    mesh.append(&part.mesh, &part.pose);
    let appearance = &part.appearance;
    let colours = [
        appearance.colour.ambient_diffuse,
        appearance.colour.specular,
        appearance.colour.emission,
    ]
    .as_flattened()
    .to_vec();
    let mut viz = Data::map([
        ("vertices", mesh.flat_vertices().into()),
        ("indices", mesh.flat_indices().into()),
        ("normals", mesh.flat_normals().into()),
        (
            "colors",
            colours
                .into_iter()
                .map(f64::from)
                .collect::<Vec<f64>>()
                .into(),
        ),
        ("shadingAngle", appearance.shading_angle.into()),
        (
            "transparency",
            (1.0 - f64::from(appearance.colour.opacity)).into(),
        ),
        (
            "options",
            (i64::from(appearance.culling) | i64::from(appearance.wireframe) << 1).into(),
        ),
    ]);
    if let (Data::Map(entries), Some(texture)) = (&mut viz, texture::viz(scene, part)) {
        entries.push((Key::Text(b"texture".to_vec()), texture));
    }
    viz
}

/// Moves the frame of a shape; geometry and children stay where they are.
///
/// @param shapeHandle the shape
/// @param pose in the world; a quaternion of zeros means the frame of the bounding box
/// @return result false for a single primitive, which keeps its frame
#[api("sim.relocateShapeFrame")]
fn relocate_shape_frame(cx: &mut Cx, shape_handle: Handle, pose: [f64; 7]) -> Result<bool> {
    let pose = (!has_no_rotation(&pose)).then(|| pose_from_array(&pose));
    Ok(cx.scene_mut().relocate_shape_frame(shape_handle, pose)?)
}

/// Turns the bounding box of a shape.
///
/// @param shapeHandle the shape
/// @param pose its quaternion is the orientation in the world; zeros mean the tightest box
/// @return result false for a single primitive, which keeps its box
#[api("sim.alignShapeBB")]
fn align_shape_bb(cx: &mut Cx, shape_handle: Handle, pose: [f64; 7]) -> Result<bool> {
    let rotation = (!has_no_rotation(&pose)).then(|| pose_from_array(&pose).rotation);
    Ok(cx.scene_mut().align_shape_box(shape_handle, rotation)?)
}

fn has_no_rotation(pose: &[f64; 7]) -> bool {
    pose[3..].iter().all(|&element| element == 0.0)
}
