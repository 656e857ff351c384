//! What stands in chunks: numbers, texts, lists, poses. Lengths are metres, angles radians, numbers little endian.

use nalgebra::{Quaternion, UnitQuaternion};

use super::error::FileResult;
use super::node::{Node, NodeResult, at};
use super::read::{Reader, Real, Tag};
use super::write::Writer;
use crate::scene::Pose;

/// The payload of a chunk, or a part of it.
pub trait Value: Sized {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self>;
    /// With double precision, as current programs do.
    fn write(&self, out: &mut Writer);

    /// The tag of its chunk, where it is not always that of its field.
    fn tag(&self, of_field: Tag) -> Tag {
        of_field
    }

    fn to_node(&self) -> Node;
    fn from_node(node: &Node) -> NodeResult<Self>;
}

/// A value of fixed width.
pub trait Plain: Copy {
    fn size(real: Real) -> usize;
    /// From just as many bytes.
    fn get(bytes: &[u8], real: Real) -> Self;
    fn put(self, out: &mut Vec<u8>);
    fn node(self) -> Node;
    fn of_node(node: &Node) -> NodeResult<Self>;
}

macro_rules! plain {
    ($($number:ty = $kind:ident $get:ident),*) => {$(
        impl Plain for $number {
            fn size(_: Real) -> usize {
                size_of::<Self>()
            }
            fn get(bytes: &[u8], _: Real) -> Self {
                Self::from_le_bytes(bytes.try_into().expect("as many bytes as the size says"))
            }
            fn put(self, out: &mut Vec<u8>) {
                out.extend(self.to_le_bytes());
            }
            fn node(self) -> Node {
                Node::$kind(self as _)
            }
            fn of_node(node: &Node) -> NodeResult<Self> {
                plain_of!($kind, node.$get()?)
            }
        }
    )*};
}

macro_rules! plain_of {
    (Int, $int:expr) => {
        Self::try_from($int).map_err(|_| "a number is out of range".to_owned())
    };
    ($real:ident, $value:expr) => {
        Ok($value as Self)
    };
}

plain!(u8 = Int int, u16 = Int int, i32 = Int int, i64 = Int int, u64 = Int int, f32 = Single real);

/// A real number: of single precision in files up to serialization 24. What is single for good is an `f32`.
impl Plain for f64 {
    fn size(real: Real) -> usize {
        if real == Real::Single { 4 } else { 8 }
    }

    fn get(bytes: &[u8], real: Real) -> Self {
        match real {
            Real::Single => f32::get(bytes, real).into(),
            Real::Double => Self::from_le_bytes(bytes.try_into().expect("as many bytes as the size says")),
        }
    }

    fn put(self, out: &mut Vec<u8>) {
        out.extend(self.to_le_bytes());
    }

    fn node(self) -> Node {
        Node::Real(self)
    }

    fn of_node(node: &Node) -> NodeResult<Self> {
        node.real()
    }
}

impl<T: Plain> Value for T {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        Ok(T::get(input.take(T::size(real))?, real))
    }

    fn write(&self, out: &mut Writer) {
        self.put(&mut out.bytes);
    }

    fn to_node(&self) -> Node {
        self.node()
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        T::of_node(node)
    }
}

impl<T: Plain + Default, const N: usize> Value for [T; N] {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        let mut all = [T::default(); N];
        for one in &mut all {
            *one = Value::read(input, real)?;
        }
        Ok(all)
    }

    fn write(&self, out: &mut Writer) {
        self.iter().for_each(|one| one.put(&mut out.bytes));
    }

    fn to_node(&self) -> Node {
        Node::List(self.iter().map(|one| one.node()).collect())
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        let mut all = [T::default(); N];
        for (one, node) in all.iter_mut().zip(node.items::<N>()?) {
            *one = T::of_node(node)?;
        }
        Ok(all)
    }
}

macro_rules! tuple {
    ($($name:ident)*) => {
        impl<$($name: Value),*> Value for ($($name,)*) {
            fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
                Ok(($($name::read(input, real)?,)*))
            }
            #[allow(non_snake_case)]
            fn write(&self, out: &mut Writer) {
                let ($($name,)*) = self;
                $($name.write(out);)*
            }
            #[allow(non_snake_case)]
            fn to_node(&self) -> Node {
                let ($($name,)*) = self;
                Node::List(vec![$($name.to_node()),*])
            }
            #[allow(non_snake_case)]
            fn from_node(node: &Node) -> NodeResult<Self> {
                let [$($name),*] = node.items()?;
                Ok(($($name::from_node($name)?,)*))
            }
        }
    };
}

tuple!(A B);
tuple!(A B C);
tuple!(A B C D);
tuple!(A B C D E);
tuple!(A B C D E F);

/// A text or other bytes behind their length. Mostly UTF-8; names and scripts of old Windows programs are Latin-1.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Text(pub Vec<u8>);

impl Text {
    /// As UTF-8, or else as Latin-1.
    pub fn decode(&self) -> String {
        decode(&self.0)
    }
}

impl From<&str> for Text {
    fn from(text: &str) -> Self {
        Self(text.as_bytes().to_vec())
    }
}

/// Bytes as UTF-8, or as Latin-1 where they are not UTF-8.
pub fn decode(bytes: &[u8]) -> String {
    std::str::from_utf8(bytes).map_or_else(|_| bytes.iter().map(|b| char::from(*b)).collect(), str::to_owned)
}

impl Value for Text {
    fn read(input: &mut Reader<'_>, _: Real) -> FileResult<Self> {
        let length = input.count(1)?;
        Ok(Self(input.take(length)?.to_vec()))
    }

    fn write(&self, out: &mut Writer) {
        out.int(self.0.len() as i32);
        out.bytes.extend(&self.0);
    }

    fn to_node(&self) -> Node {
        match std::str::from_utf8(&self.0) {
            Ok(text) => Node::Text(text.to_owned()),
            Err(_) => Node::Bytes(self.0.clone()),
        }
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        node.bytes().map(Self)
    }
}

/// Things behind their number.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Counted<T>(pub Vec<T>);

impl<T: Value> Value for Counted<T> {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        // Every value takes a byte at least, so a number that lies ends in an error before it costs memory.
        let count = input.count(1)?;
        (0..count).map(|_| T::read(input, real)).collect::<FileResult<_>>().map(Self)
    }

    fn write(&self, out: &mut Writer) {
        out.int(self.0.len() as i32);
        self.0.iter().for_each(|one| one.write(out));
    }

    fn to_node(&self) -> Node {
        Node::List(self.0.iter().map(Value::to_node).collect())
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        let items = node.list()?.iter().enumerate();
        items.map(|(i, item)| at(&i.to_string(), T::from_node(item))).collect::<NodeResult<_>>().map(Self)
    }
}

/// Things until the chunk ends.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rest<T>(pub Vec<T>);

impl<T: Plain> Value for Rest<T> {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        let size = T::size(real);
        if !input.left().is_multiple_of(size) {
            return Err(input.error(format!("{} bytes are not a multiple of {size}", input.left())));
        }
        Ok(Self(input.take_rest().chunks_exact(size).map(|bytes| T::get(bytes, real)).collect()))
    }

    fn write(&self, out: &mut Writer) {
        self.0.iter().for_each(|one| one.put(&mut out.bytes));
    }

    /// Single bytes as bytes, numbers as a list.
    fn to_node(&self) -> Node {
        if T::size(Real::Double) > 1 {
            return Node::List(self.0.iter().map(|one| one.node()).collect());
        }
        let mut bytes = Vec::new();
        self.0.iter().for_each(|one| one.put(&mut bytes));
        Node::Bytes(bytes)
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        if T::size(Real::Double) > 1 {
            return node.list()?.iter().map(T::of_node).collect::<NodeResult<_>>().map(Self);
        }
        Ok(Self(node.bytes()?.chunks_exact(1).map(|byte| T::get(byte, Real::Double)).collect()))
    }
}

/// A pose that begins with its quaternion: w x y z, then the position.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RotationFirst(pub [f64; 7]);

/// A pose that begins with its position, then the quaternion, w x y z.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PositionFirst(pub [f64; 7]);

impl RotationFirst {
    /// With a quaternion of length one; nothing if a number is not finite.
    pub fn pose(&self) -> Option<Pose> {
        let [w, x, y, z, position @ ..] = self.0;
        pose(position, [w, x, y, z])
    }
}

impl From<Pose> for RotationFirst {
    fn from(pose: Pose) -> Self {
        let (q, p) = (pose.rotation, pose.translation);
        Self([q.w, q.i, q.j, q.k, p.x, p.y, p.z])
    }
}

impl PositionFirst {
    /// With a quaternion of length one; nothing if a number is not finite.
    pub fn pose(&self) -> Option<Pose> {
        let [x, y, z, rotation @ ..] = self.0;
        pose([x, y, z], rotation)
    }
}

impl From<Pose> for PositionFirst {
    fn from(pose: Pose) -> Self {
        let (q, p) = (pose.rotation, pose.translation);
        Self([p.x, p.y, p.z, q.w, q.i, q.j, q.k])
    }
}

fn pose(position: [f64; 3], rotation: [f64; 4]) -> Option<Pose> {
    position
        .iter()
        .chain(&rotation)
        .all(|n| n.is_finite())
        .then(|| Pose::from_parts(position.into(), unit_quaternion(rotation)))
}

/// The rotation w x y z, made one in length; none at all where the length is zero.
pub fn unit_quaternion([w, x, y, z]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-12).unwrap_or_default()
}

macro_rules! wrapped {
    ($($name:ident),*) => {$(
        impl Value for $name {
            fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
                Value::read(input, real).map(Self)
            }
            fn write(&self, out: &mut Writer) {
                self.0.write(out);
            }
            fn to_node(&self) -> Node {
                self.0.to_node()
            }
            fn from_node(node: &Node) -> NodeResult<Self> {
                Value::from_node(node).map(Self)
            }
        }
    )*};
}

wrapped!(RotationFirst, PositionFirst);

/// What one physics engine needs to know of a thing, in the order of its tables (appendix C of the format).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EngineBlock {
    pub reals: Vec<f64>,
    pub ints: Vec<i32>,
}

impl Value for EngineBlock {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        let reals = input.count(f64::size(real))?;
        let ints = input.count(4)?;
        let reals = (0..reals).map(|_| f64::read(input, real)).collect::<FileResult<_>>()?;
        let ints = (0..ints).map(|_| input.int()).collect::<FileResult<_>>()?;
        Ok(Self { reals, ints })
    }

    fn write(&self, out: &mut Writer) {
        out.int(self.reals.len() as i32);
        out.int(self.ints.len() as i32);
        self.reals.iter().for_each(|real| real.write(out));
        self.ints.iter().for_each(|int| out.int(*int));
    }

    fn to_node(&self) -> Node {
        Node::table([("reals", list(&self.reals)), ("ints", list(&self.ints))])
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        Ok(Self { reals: of_list(node.need("reals")?)?, ints: of_list(node.need("ints")?)? })
    }
}

fn list<T: Plain>(numbers: &[T]) -> Node {
    Node::List(numbers.iter().map(|number| number.node()).collect())
}

fn of_list<T: Plain>(node: &Node) -> NodeResult<Vec<T>> {
    node.list()?.iter().map(T::of_node).collect()
}

/// The heights of a terrain, row by row. Both counts are zero where a mesh is none.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Heights {
    pub columns: usize,
    pub rows: usize,
    pub heights: Vec<f64>,
}

impl Value for Heights {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        let (columns, rows) = (input.count(0)?, input.count(0)?);
        let Rest(heights) = Rest::read(input, real)?;
        if columns.checked_mul(rows) != Some(heights.len()) {
            return Err(
                input.error(format!("{columns} times {rows} heights are announced, {} are there", heights.len()))
            );
        }
        Ok(Self { columns, rows, heights })
    }

    fn write(&self, out: &mut Writer) {
        out.int(self.columns as i32);
        out.int(self.rows as i32);
        self.heights.iter().for_each(|height| height.write(out));
    }

    fn to_node(&self) -> Node {
        let count = |n: usize| Node::Int(n as i64);
        Node::table([("columns", count(self.columns)), ("rows", count(self.rows)), ("heights", list(&self.heights))])
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        let count = |name| usize::try_from(node.need(name)?.int()?).map_err(|_| "a number is out of range".to_owned());
        let (columns, rows, heights) = (count("columns")?, count("rows")?, of_list::<f64>(node.need("heights")?)?);
        if columns.checked_mul(rows) != Some(heights.len()) {
            return Err(format!("{} heights are not {columns} times {rows}", heights.len()));
        }
        Ok(Self { columns, rows, heights })
    }
}

/// Triangle corners: plain numbers, or the packed differences of files before 4.5.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Indices(pub Vec<i32>);

impl Value for Indices {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        if input.tag() == *b"In2" {
            return unpack_indices(input).map(Self);
        }
        Rest::read(input, real).map(|Rest(indices)| Self(indices))
    }

    fn write(&self, out: &mut Writer) {
        self.0.iter().for_each(|index| out.int(*index));
    }

    fn to_node(&self) -> Node {
        list(&self.0)
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        of_list(node).map(Self)
    }
}

/// Differences in one to four bytes: the high bits of the first byte tell how many follow.
fn unpack_indices(input: &mut Reader<'_>) -> FileResult<Vec<i32>> {
    const MIDDLE: [i32; 4] = [31, 8191, 2_097_151, 536_870_911];
    let count = input.count(1)?;
    let mut previous = 0i32;
    let mut next = || {
        let first = input.take(1)?[0];
        let more = usize::from(first >> 6);
        let low = i32::from(first & 63);
        let high = input.take(more)?.iter().enumerate().map(|(i, byte)| i32::from(*byte) << (6 + 8 * i));
        previous = previous.wrapping_add(low + high.sum::<i32>() - MIDDLE[more]);
        Ok(previous)
    };
    (0..count).map(|_| next()).collect()
}

/// Normals, x y z per triangle corner: plain, or in five bits each, of files before 4.5.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Normals(pub Vec<f32>);

impl Value for Normals {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        if input.tag() != *b"No2" {
            return Rest::read(input, real).map(|Rest(normals)| Self(normals));
        }
        let Rest(packed) = Rest::<u16>::read(input, real)?;
        Ok(Self(packed.into_iter().flat_map(unpack_normal).collect()))
    }

    fn write(&self, out: &mut Writer) {
        self.0.iter().for_each(|number| number.put(&mut out.bytes));
    }

    fn to_node(&self) -> Node {
        list(&self.0)
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        of_list(node).map(Self)
    }
}

fn unpack_normal(packed: u16) -> [f32; 3] {
    let parts = [0, 5, 10].map(|shift| f32::from(packed >> shift & 31) - 15.0);
    let length = parts.iter().map(|c| c * c).sum::<f32>().sqrt();
    if length > 0.0 { parts.map(|c| c / length) } else { parts }
}

/// A reference to an object by the identity it was saved with; the identity is missing where the handle is negative.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OriginalReference {
    pub kind: i32,
    pub handle: i32,
    pub persistent_id: Option<Text>,
}

impl Value for OriginalReference {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        let [kind, handle] = Value::read(input, real)?;
        let persistent_id = if handle < 0 { None } else { Some(Text::read(input, real)?) };
        Ok(Self { kind, handle, persistent_id })
    }

    fn write(&self, out: &mut Writer) {
        [self.kind, self.handle].write(out);
        if let Some(id) = &self.persistent_id {
            id.write(out);
        }
    }

    fn to_node(&self) -> Node {
        let id = self.persistent_id.as_ref().map(|id| ("persistent_id", id.to_node()));
        Node::table([("kind", self.kind.node()), ("handle", self.handle.node())].into_iter().chain(id))
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        let (kind, handle) = (i32::of_node(node.need("kind")?)?, i32::of_node(node.need("handle")?)?);
        Ok(Self { kind, handle, persistent_id: node.get("persistent_id").map(Text::from_node).transpose()? })
    }
}

/// The text of a script. Files hide it a little; here it is plain.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ScriptText(pub Vec<u8>);

impl Value for ScriptText {
    fn read(input: &mut Reader<'_>, _: Real) -> FileResult<Self> {
        let mut text = input.take_rest().to_vec();
        shift_text(&mut text, u8::wrapping_add);
        let length = text.iter().rposition(|byte| *byte != 0).map_or(0, |last| last + 1);
        text.truncate(length);
        Ok(Self(text))
    }

    fn write(&self, out: &mut Writer) {
        let mut text = self.0.clone();
        shift_text(&mut text, u8::wrapping_sub);
        out.bytes.extend(text);
    }

    fn to_node(&self) -> Node {
        Node::Script(self.0.clone())
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        node.bytes().map(Self)
    }
}

/// Moves every byte but the first and the last by a number that depends on its place and on these two.
fn shift_text(text: &mut [u8], shift: fn(u8, u8) -> u8) {
    let [first, middle @ .., last] = text else { return };
    let start = i64::from(*first as i8 / 2);
    let end = i64::from(*last as i8) * 3;
    for (i, byte) in (1i64..).zip(middle) {
        let terms = [(1, i + start + end), (2, -(3 * i + start)), (4, i / 2 + end)];
        let amount: i64 = terms.iter().filter(|(bit, _)| i & bit != 0).map(|(_, term)| term).sum();
        *byte = shift(*byte, amount as u8);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::RefCell;

    fn read<T: Value>(bytes: &[u8], tag: &[u8; 3]) -> FileResult<T> {
        let mut chunk = tag.to_vec();
        chunk.extend((bytes.len() as i32).to_le_bytes());
        chunk.extend(bytes);
        let skipped = RefCell::default();
        let mut reader = Reader::new(&chunk, &skipped);
        let mut payload = reader.chunk(*b"EOO")?.expect("a chunk");
        let value = T::read(&mut payload, Real::Single)?;
        payload.finish()?;
        Ok(value)
    }

    fn written(value: &impl Value) -> Vec<u8> {
        let mut out = Writer::default();
        value.write(&mut out);
        out.bytes
    }

    #[test]
    fn packed_indices_are_differences() {
        // 0, 1, then a difference of 100 in two bytes: 8291 = 35 + 129 * 64.
        let Indices(found) = read(&[3, 0, 0, 0, 31, 32, 0x40 | 35, 129], b"In2").unwrap();
        assert_eq!(found, [0, 1, 101]);
        assert!(read::<Indices>(&[9, 0, 0, 0, 31], b"In2").is_err());
    }

    #[test]
    fn packed_normals_have_length_one() {
        let Normals(found) = read(&(15u16 | 15 << 5 | 30 << 10).to_le_bytes(), b"No2").unwrap();
        assert_eq!(found, [0.0, 0.0, 1.0]);
    }

    #[test]
    fn the_text_of_a_script_comes_back() {
        let text = ScriptText("function sysCall_init()\n\tprint('h\u{e4}')\nend".as_bytes().to_vec());
        let hidden = written(&text);
        assert_ne!(hidden, text.0);
        assert_eq!(read::<ScriptText>(&hidden, b"Ste").unwrap(), text);
        assert_eq!(read::<ScriptText>(b"ab", b"Ste").unwrap().0, b"ab");
    }

    #[test]
    fn numbers_that_lie_cost_nothing() {
        for bytes in [[255, 255, 255, 127], [255, 255, 255, 255]] {
            assert!(read::<Counted<[f64; 3]>>(&bytes, b"xyz").is_err());
            assert!(read::<Text>(&bytes, b"xyz").is_err());
        }
        assert!(read::<EngineBlock>(&[1, 0, 0, 0, 200, 0, 0, 0, 1, 1, 1, 1], b"xyz").is_err());
        assert!(read::<Heights>(&[2, 0, 0, 0, 2, 0, 0, 0, 1, 1, 1, 1], b"_fd").is_err());
    }
}
