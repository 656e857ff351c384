//! Values in chunks: numbers, strings, lists, poses. Metres, radians, little endian (spec: scene-files 1).

mod list;
mod mesh;
mod pose;
mod record;
mod text;

pub use list::{Counted, Rest};
pub use mesh::{Heights, Indices, Normals};
pub use pose::{PositionFirst, RotationFirst, unit_quaternion};
pub use record::{EngineBlock, OriginalReference};
pub use text::{ScriptText, Text, decode};

use super::error::FileResult;
use super::node::{Node, NodeResult};
use super::read::{Reader, Real, Tag};
use super::write::Writer;

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
            #[allow(
                clippy::cast_lossless,
                clippy::cast_possible_wrap,
                reason = "one rule for all types; 64 bits without a sign keep their bits"
            )]
            fn node(self) -> Node {
                Node::$kind(self as _)
            }
            #[allow(clippy::cast_possible_truncation, reason = "single precision is what the file keeps")]
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
            Real::Double => {
                Self::from_le_bytes(bytes.try_into().expect("as many bytes as the size says"))
            }
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
        let text = ScriptText(
            "function sysCall_init()\n\tprint('h\u{e4}')\nend"
                .as_bytes()
                .to_vec(),
        );
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
