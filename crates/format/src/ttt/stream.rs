//! Streams of chunks as types: a table of tags becomes a struct, its reader and its writer.

use super::error::FileResult;
use super::node::{Node, NodeResult, at};
use super::read::{Reader, Real, Tag};
use super::value::Value;
use super::write::Writer;

/// A sequence of chunks that ends with a tag of its own.
pub trait Stream: Default {
    const END: Tag;

    /// Takes one chunk; false if its tag is unknown here.
    fn take(&mut self, chunk: &mut Reader<'_>) -> FileResult<bool>;

    fn write_chunks(&self, out: &mut Writer);

    /// The fields that are there, by their names.
    fn entries(&self) -> Vec<(String, Node)>;

    /// # Errors
    /// When a name is unknown, or its value is not what it should be.
    fn of_entries(entries: &[(String, Node)]) -> NodeResult<Self>;

    /// Reads to the end of the stream. What comes twice counts the second time; what is unknown is skipped and noted.
    fn read_stream(input: &mut Reader<'_>) -> FileResult<Self> {
        let mut stream = Self::default();
        while let Some(mut chunk) = input.chunk(Self::END)? {
            if stream.take(&mut chunk)? {
                chunk.finish()?;
            } else {
                chunk.skip();
            }
        }
        Ok(stream)
    }

    fn write_stream(&self, out: &mut Writer) {
        self.write_chunks(out);
        out.end(Self::END);
    }
}

/// A field of a stream: once, or any number of times.
pub trait Slot {
    fn fill(&mut self, chunk: &mut Reader<'_>, real: Real) -> FileResult<()>;
    fn write(&self, tag: Tag, out: &mut Writer);
    /// Nothing where it is missing.
    fn to_node(&self) -> Option<Node>;
    fn fill_from_node(&mut self, node: &Node) -> NodeResult<()>;
}

impl<T: Value> Slot for Option<T> {
    fn fill(&mut self, chunk: &mut Reader<'_>, real: Real) -> FileResult<()> {
        *self = Some(T::read(chunk, real)?);
        Ok(())
    }

    fn write(&self, tag: Tag, out: &mut Writer) {
        if let Some(value) = self {
            out.chunk(value.tag(tag), |out| value.write(out));
        }
    }

    fn to_node(&self) -> Option<Node> {
        self.as_ref().map(Value::to_node)
    }

    fn fill_from_node(&mut self, node: &Node) -> NodeResult<()> {
        *self = Some(T::from_node(node)?);
        Ok(())
    }
}

impl<T: Value> Slot for Vec<T> {
    fn fill(&mut self, chunk: &mut Reader<'_>, real: Real) -> FileResult<()> {
        self.push(T::read(chunk, real)?);
        Ok(())
    }

    fn write(&self, tag: Tag, out: &mut Writer) {
        self.iter()
            .for_each(|value| out.chunk(value.tag(tag), |out| value.write(out)));
    }

    fn to_node(&self) -> Option<Node> {
        (!self.is_empty()).then(|| Node::List(self.iter().map(Value::to_node).collect()))
    }

    fn fill_from_node(&mut self, node: &Node) -> NodeResult<()> {
        let items = node.list()?.iter().enumerate();
        *self = items
            .map(|(i, item)| at(&i.to_string(), T::from_node(item)))
            .collect::<NodeResult<_>>()?;
        Ok(())
    }
}

/// # Errors
/// When the node is no table.
pub fn entries_of(node: &Node) -> NodeResult<&[(String, Node)]> {
    if let Node::Table(entries) = node {
        Ok(entries)
    } else {
        Err("a table is needed".into())
    }
}

/// Declares streams: each field stands with its tag and, after `/`, the tag of its predecessor with single precision. Tags after `|`
/// are read into the same field.
/// Fields are written in their order, those that are there.
macro_rules! streams {
    ($($(#[$doc:meta])* $name:ident until $end:literal {
        $($(#[$field_doc:meta])* $field:ident: $type:ty = $tag:literal $(| $other:literal)* $(/ $single:literal)?,)*
    })*) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Default, PartialEq)]
        pub struct $name {
            $($(#[$field_doc])* pub $field: $type,)*
        }

        impl $crate::ttt::stream::Stream for $name {
            const END: $crate::ttt::read::Tag = *$end;

            fn take(&mut self, chunk: &mut $crate::ttt::read::Reader<'_>) -> $crate::ttt::error::FileResult<bool> {
                use $crate::ttt::{read::Real, stream::Slot};
                match &chunk.tag() {
                    $($tag $(| $other)* => self.$field.fill(chunk, Real::Double)?,
                    $($single => self.$field.fill(chunk, Real::Single)?,)?)*
                    _ => return Ok(false),
                }
                Ok(true)
            }

            fn write_chunks(&self, out: &mut $crate::ttt::write::Writer) {
                use $crate::ttt::stream::Slot;
                $(self.$field.write(*$tag, out);)*
            }

            fn entries(&self) -> Vec<(String, $crate::ttt::node::Node)> {
                use $crate::ttt::stream::Slot;
                let all = [$((stringify!($field), self.$field.to_node())),*];
                all.into_iter().filter_map(|(name, node)| Some((name.to_owned(), node?))).collect()
            }

            fn of_entries(
                entries: &[(String, $crate::ttt::node::Node)],
            ) -> $crate::ttt::node::NodeResult<Self> {
                use $crate::ttt::{node::at, stream::Slot};
                let mut stream = Self::default();
                for (name, node) in entries {
                    match name.as_str() {
                        $(stringify!($field) => at(name, stream.$field.fill_from_node(node))?,)*
                        _ => return Err(format!("`{name}` is unknown here")),
                    }
                }
                Ok(stream)
            }
        }

        impl $crate::ttt::value::Value for $name {
            fn read(
                input: &mut $crate::ttt::read::Reader<'_>,
                _: $crate::ttt::read::Real,
            ) -> $crate::ttt::error::FileResult<Self> {
                <Self as $crate::ttt::stream::Stream>::read_stream(input)
            }

            fn write(&self, out: &mut $crate::ttt::write::Writer) {
                $crate::ttt::stream::Stream::write_stream(self, out);
            }

            fn to_node(&self) -> $crate::ttt::node::Node {
                $crate::ttt::node::Node::Table($crate::ttt::stream::Stream::entries(self))
            }

            fn from_node(node: &$crate::ttt::node::Node) -> $crate::ttt::node::NodeResult<Self> {
                $crate::ttt::stream::Stream::of_entries($crate::ttt::stream::entries_of(node)?)
            }
        }
    )*};
}

pub(super) use streams;
