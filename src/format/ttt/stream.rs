//! Streams of chunks as types: a table of tags becomes a struct, its reader and its writer.

use super::error::FileResult;
use super::read::{Reader, Real, Tag};
use super::value::Value;
use super::write::Writer;

/// A sequence of chunks that ends with a tag of its own.
pub trait Stream: Default {
    const END: Tag;

    /// Takes one chunk; false if its tag is unknown here.
    fn take(&mut self, chunk: &mut Reader<'_>) -> FileResult<bool>;

    fn write_chunks(&self, out: &mut Writer);

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
}

impl<T: Value> Slot for Vec<T> {
    fn fill(&mut self, chunk: &mut Reader<'_>, real: Real) -> FileResult<()> {
        self.push(T::read(chunk, real)?);
        Ok(())
    }

    fn write(&self, tag: Tag, out: &mut Writer) {
        self.iter().for_each(|value| out.chunk(value.tag(tag), |out| value.write(out)));
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

        impl $crate::format::ttt::stream::Stream for $name {
            const END: $crate::format::ttt::read::Tag = *$end;

            fn take(&mut self, chunk: &mut $crate::format::ttt::read::Reader<'_>) -> $crate::format::ttt::error::FileResult<bool> {
                use $crate::format::ttt::{read::Real, stream::Slot};
                match &chunk.tag() {
                    $($tag $(| $other)* => self.$field.fill(chunk, Real::Double)?,
                    $($single => self.$field.fill(chunk, Real::Single)?,)?)*
                    _ => return Ok(false),
                }
                Ok(true)
            }

            fn write_chunks(&self, out: &mut $crate::format::ttt::write::Writer) {
                use $crate::format::ttt::stream::Slot;
                $(self.$field.write(*$tag, out);)*
            }
        }

        impl $crate::format::ttt::value::Value for $name {
            fn read(
                input: &mut $crate::format::ttt::read::Reader<'_>,
                _: $crate::format::ttt::read::Real,
            ) -> $crate::format::ttt::error::FileResult<Self> {
                <Self as $crate::format::ttt::stream::Stream>::read_stream(input)
            }

            fn write(&self, out: &mut $crate::format::ttt::write::Writer) {
                $crate::format::ttt::stream::Stream::write_stream(self, out);
            }
        }
    )*};
}

pub(super) use streams;
