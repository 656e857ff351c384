//! Meshes by addresses: imported, exported, reduced, with their appearance; terrain and textures.

use scene::{Data, Key};

use super::pointers::{area, floats, integers_of, singles};
use crate::dispatch::Call;
use crate::functions::{Answer, Function};

/// The functions by their names in the table of symbols.
pub(super) const FUNCTIONS: &[(&str, Function)] = &[
    ("mesh.import", import),
    ("mesh.export", export),
    ("mesh.decimate", decimate),
    ("shape.create", create_shape),
    ("shape.vertex", vertex),
    ("shape.triangle", triangle),
    ("shape.viz", viz),
    ("shape.heightfield", heightfield),
    ("shape.texture", apply_texture),
    ("texture.create", create_texture),
];

/// Parameters: format, file, options, tolerance, scale; where the lists of vertices, their lengths, of indices, their lengths, nothing
/// and the list of names go. Returns the number of meshes.
fn import(call: &Call<'_>) -> Answer {
    let results = call.frame.host().call("sim.importMesh", &call.args[..5])?;
    let lists = |place: usize| match results.get(place) {
        Some(Data::Array(lists)) => lists.as_slice(),
        _ => &[],
    };
    let (vertices, indices) = (lists(0), lists(1));
    write_lists(call, 5, call.number_letter(), vertices);
    write_lists(call, 7, 'I', indices);
    call.write_at(9, &[0_usize]);
    let names: Vec<Vec<u8>> = (0..vertices.len())
        .map(|number| format!("mesh{number}").into_bytes())
        .collect();
    call.write_at(10, &[call.frame.keep_texts(&names)]);
    Ok(vec![Data::Int(scene::numbers::count(vertices.len()))])
}

/// The address of a list of lists, and that of the list of their lengths.
fn write_lists(call: &Call<'_>, place: usize, ty: char, lists: &[Data]) {
    let (mut addresses, mut lengths) = (Vec::new(), Vec::new());
    for list in lists {
        let mut length = 0;
        let address = call.frame.keep(ty, Some(list.clone()), &mut length);
        addresses.extend(address.to_ne_bytes());
        lengths.extend(i32::try_from(length).unwrap_or(i32::MAX).to_ne_bytes());
    }
    let kept = [addresses, lengths].map(|bytes| {
        let mut length = 0;
        call.frame.keep('S', Some(Data::Buffer(bytes)), &mut length)
    });
    call.write_at(place, &kept[..1]);
    call.write_at(place + 1, &kept[1..]);
}

/// Parameters: format, file, options, scale, count of meshes; lists of vertices, their lengths, of indices, their lengths.
fn export(call: &Call<'_>) -> Answer {
    let count = call.count_at(4)?;
    let lengths = |place| call.lengths_at(place, count);
    let vertices = call.number_lists_at(5, &lengths(6)?)?;
    let indices: Vec<Data> = call
        .lists_at::<i32>(7, &lengths(8)?)?
        .into_iter()
        .map(|list| list.into_iter().map(i64::from).collect::<Vec<_>>().into())
        .collect();
    let mut args = call.args[..4].to_vec();
    args.extend([Data::Array(vertices), Data::Array(indices)]);
    call.frame.host().call("sim.exportMesh", &args)
}

/// Parameters: vertices, count of their numbers, indices, their count, where the results go, the fraction that remains.
fn decimate(call: &Call<'_>) -> Answer {
    let args = [
        call.numbers_at(0, call.count_at(1)?)?,
        call.integers_at(2, call.count_at(3)?)?,
        Data::Float(call.number_at(8)),
    ];
    let results = call.frame.host().call("sim.getDecimatedMesh", &args)?;
    Ok([Data::Int(1)].into_iter().chain(results).collect())
}

/// Parameters: options, angle, columns, rows, size, heights.
fn heightfield(call: &Call<'_>) -> Answer {
    let points = call.count_at(2)?.saturating_mul(call.count_at(3)?);
    let mut args = call.args[..5].to_vec();
    args.push(call.numbers_at(5, points)?);
    call.frame.host().call("sim.createHeightfieldShape", &args)
}

/// Parameters: shape, coordinates, their count, pixels, width and height, options. Option 16: pixels have an opacity.
fn apply_texture(call: &Call<'_>) -> Answer {
    let sides = call.list_at::<i32>(4, 2)?;
    let bytes = image_bytes([sides[0], sides[1]], call.integer_at(5));
    let args = [
        Data::Int(call.integer_at(0)),
        call.numbers_at(1, call.count_at(2)?)?,
        Data::Text(call.list_at(3, bytes)?),
        call.integers_at(4, 2)?,
        Data::Int(call.integer_at(5)),
    ];
    call.frame
        .host()
        .call("swanilda.library.applyTexture", &args)
}

/// Parameters: file, options, size of the plane, of the image, placement, whether the resolution is fixed, where the texture goes, the
/// resolution.
fn create_texture(call: &Call<'_>) -> Answer {
    let mut args = call.args[..4].to_vec();
    args.push(call.optional_numbers_at(4, 3)?);
    args.push(Data::Int(call.integer_at(5)));
    args.push(call.optional_integers_at(7, 2)?);
    call.frame.host().call("sim.createTexture", &args)
}

/// Parameters: options, shading angle, vertices, indices, three numbers of a normal and two coordinates of a texture for each index,
/// pixels, width and height. Option 16: pixels have an opacity.
fn create_shape(call: &Call<'_>) -> Answer {
    let corners = match call.arg(3) {
        Data::Array(indices) => indices.len(),
        _ => 0,
    };
    let bytes = match integers_of(call.arg(7))[..] {
        [width, height] => image_bytes([width, height], call.integer_at(0)),
        _ => 0,
    };
    let mut args = call.args[..4].to_vec();
    args.push(call.optional_numbers_at(4, corners.saturating_mul(3))?);
    let coordinates: Option<Vec<f32>> = call.optional_at(5, corners.saturating_mul(2))?;
    args.push(coordinates.map_or(Data::Nil, floats));
    let texture: Option<Vec<u8>> = call.optional_at(6, bytes)?;
    args.push(texture.map_or(Data::Nil, Data::Buffer));
    args.push(call.arg(7).clone());
    call.frame.host().call("sim.createShape", &args)
}

/// Option of textures: there is an opacity for each pixel.
const WITH_OPACITY: i64 = 16;

fn image_bytes(sides: [i32; 2], options: i64) -> usize {
    let channels = if options & WITH_OPACITY == 0 { 3 } else { 4 };
    area(sides).saturating_mul(channels)
}

/// Parameters: shape, its mesh, vertex. Whether there is such a vertex, and its place in the frame of the shape.
fn vertex(call: &Call<'_>) -> Answer {
    let mesh = mesh_of(call)?;
    Ok(match items_at(&entry(&mesh, "vertices"), call.int(2)?, 3) {
        Some(place) => vec![Data::Int(1), place],
        None => vec![Data::Int(0)],
    })
}

/// Parameters: shape, its mesh, triangle. Whether there is such a triangle, its vertices, and the normals there.
fn triangle(call: &Call<'_>) -> Answer {
    let mesh = mesh_of(call)?;
    let at = |name, size| items_at(&entry(&mesh, name), call.int(2).unwrap_or(-1), size);
    Ok(match at("indices", 3) {
        Some(indices) => vec![Data::Int(1), indices, at("normals", 9).unwrap_or(Data::Nil)],
        None => vec![Data::Int(0)],
    })
}

/// What there is of one mesh of a shape; nothing behind the last one.
fn mesh_of(call: &Call<'_>) -> Result<Vec<(Key, Data)>, String> {
    let results = call.frame.host().call("sim.getShapeViz", &call.args[..2])?;
    Ok(match results.into_iter().next() {
        Some(Data::Map(mesh)) => mesh,
        _ => Vec::new(),
    })
}

/// The items of a list that belong to one of its elements, each of which has `size` items.
fn items_at(list: &Data, place: i64, size: usize) -> Option<Data> {
    let Data::Array(items) = list else {
        return None;
    };
    let place = usize::try_from(place).ok()?;
    let found = items.chunks_exact(size).nth(place)?;
    Some(Data::Array(found.to_vec()))
}

/// Writes a `SShapeVizInfo`. Returns 0 where the shape has no such mesh, 1 without and 2 with a texture.
fn viz(call: &Call<'_>) -> Answer {
    let mesh = mesh_of(call)?;
    let mesh = &mesh[..];
    if mesh.is_empty() {
        return Ok(vec![Data::Int(0)]);
    }
    let mut info = Structure::default();
    info.list(call, 0, 'F', entry(mesh, "vertices"));
    info.list(call, 16, 'I', entry(mesh, "indices"));
    info.floats(
        28,
        &singles(&Data::Array(vec![entry(mesh, "shadingAngle")])),
    );
    info.address(call, 32, 'F', entry(mesh, "normals"));
    info.floats(40, &singles(&entry(mesh, "colors")));
    let has_texture = info.texture(call, &entry(mesh, "texture"));
    call.write_at(2, &info.0);
    Ok(vec![Data::Int(if has_texture { 2 } else { 1 })])
}

/// A value of a map; nil where there is none.
fn entry(map: &[(Key, Data)], name: &str) -> Data {
    let is = |key: &Key| matches!(key, Key::Text(text) if text == name.as_bytes());
    map.iter()
        .find(|(key, _)| is(key))
        .map_or(Data::Nil, |(_, value)| value.clone())
}

/// A `SShapeVizInfo`, as C lays it out on 64-bit systems.
struct Structure([u8; 120]);

impl Default for Structure {
    fn default() -> Self {
        Self([0; 120])
    }
}

impl Structure {
    fn put(&mut self, offset: usize, bytes: &[u8]) {
        let places = self.0[offset..].iter_mut();
        places.zip(bytes).for_each(|(place, byte)| *place = *byte);
    }

    fn floats(&mut self, offset: usize, numbers: &[f32]) {
        let bytes: Vec<u8> = numbers
            .iter()
            .flat_map(|number| number.to_ne_bytes())
            .collect();
        self.put(offset, &bytes);
    }

    fn integers(&mut self, offset: usize, numbers: &[i32]) {
        let bytes: Vec<u8> = numbers
            .iter()
            .flat_map(|number| number.to_ne_bytes())
            .collect();
        self.put(offset, &bytes);
    }

    /// The address of a list that the caller releases; its length.
    fn address(&mut self, call: &Call<'_>, offset: usize, ty: char, list: Data) -> i32 {
        let mut length = 0;
        let address = call.frame.keep(ty, Some(list), &mut length);
        self.put(offset, &address.to_ne_bytes());
        i32::try_from(length).unwrap_or(i32::MAX)
    }

    /// The same with the length behind it.
    fn list(&mut self, call: &Call<'_>, offset: usize, ty: char, list: Data) {
        let length = self.address(call, offset, ty, list);
        self.integers(offset + 8, &[length]);
    }

    /// The image on the mesh: red, green, blue and opacity of each pixel. Whether there is one.
    fn texture(&mut self, call: &Call<'_>, texture: &Data) -> bool {
        let Data::Map(texture) = texture else {
            return false;
        };
        let integer =
            |name| scene::numbers::low_i32(crate::dispatch::integer(&entry(texture, name)));
        self.address(call, 80, 'S', entry(texture, "texture"));
        self.integers(88, &[integer("id")]);
        self.integers(92, &integers_of(&entry(texture, "resolution")));
        self.address(call, 104, 'F', entry(texture, "coordinates"));
        self.integers(112, &[integer("applyMode"), integer("options")]);
        true
    }
}
