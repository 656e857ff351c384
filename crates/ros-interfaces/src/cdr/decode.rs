//! Bytes as records. Lengths are compared with what is there before memory is allocated.

use std::sync::Arc;

use super::{BIG, LITTLE};
use crate::{
    Array, ByteOrder, DecodeError, Duration, Element, FieldType, Layout, Number, NumberType,
    Numbers, Record, Shape, Time, Value, limits,
};

type Result<T> = std::result::Result<T, DecodeError>;

/// Bytes after the last field that only fill up a message.
const MAX_PADDING: usize = 7;

/// Reads a record behind its head of four bytes, which tells the order of bytes.
///
/// # Errors
/// If the representation is another one, bytes are missing or left, or there are too many nested records.
pub fn decode(layout: &Arc<Layout>, bytes: &[u8]) -> Result<Record> {
    let (head, body) = bytes.split_at_checked(4).ok_or(DecodeError::Short {
        length: bytes.len(),
    })?;
    let order = match head[..2] {
        _ if head[..2] == LITTLE[..2] => ByteOrder::Little,
        _ if head[..2] == BIG[..2] => ByteOrder::Big,
        _ => return Err(DecodeError::Representation([head[0], head[1]])),
    };
    let mut reader = Reader {
        body,
        position: 0,
        order,
        records: 0,
    };
    let record = reader.record(layout)?;
    let rest = body.len() - reader.position;
    if rest > MAX_PADDING {
        Err(DecodeError::Long { rest })
    } else {
        Ok(record)
    }
}

struct Reader<'a> {
    body: &'a [u8],
    position: usize,
    order: ByteOrder,
    /// Read so far, with arrays of no elements.
    records: usize,
}

impl<'a> Reader<'a> {
    fn record(&mut self, layout: &Arc<Layout>) -> Result<Record> {
        self.count_record()?;
        let values = layout
            .fields
            .iter()
            .map(|field| self.value(&field.field_type));
        let values = values.collect::<Result<_>>()?;
        // A structure of DDS has at least one member, so ROS 2 adds one.
        if layout.fields.is_empty() {
            self.take(1)?;
        }
        Ok(Record::of_codec(layout, values))
    }

    fn count_record(&mut self) -> Result<()> {
        self.records += 1;
        if self.records > limits::RECORDS {
            Err(DecodeError::Records)
        } else {
            Ok(())
        }
    }

    fn value(&mut self, field_type: &FieldType<Arc<Layout>>) -> Result<Value> {
        let element = &field_type.element;
        match field_type.shape {
            Shape::Single => self.element(element),
            Shape::Array(length) => {
                // Takes memory without any bytes, as an empty record does.
                if length == 0 {
                    self.count_record()?;
                }
                self.array(element, length).map(Value::Array)
            }
            Shape::Sequence(bound) => {
                let length = self.count()?;
                match bound {
                    Some(bound) if length > bound => Err(DecodeError::Bound { length, bound }),
                    _ => self.array(element, length).map(Value::Array),
                }
            }
        }
    }

    fn element(&mut self, element: &Element<Arc<Layout>>) -> Result<Value> {
        Ok(match element {
            Element::Number(number) => Value::Number(self.number(*number)?),
            Element::String(bound) => Value::String(self.text(*bound)?),
            Element::WString(bound) => Value::String(self.wide_text(*bound)?),
            Element::Time => Value::Time(self.time()?),
            Element::Duration => Value::Duration(self.duration()?),
            Element::Nested(layout) => Value::Record(self.record(layout)?),
        })
    }

    fn array(&mut self, element: &Element<Arc<Layout>>, length: usize) -> Result<Array> {
        Ok(match element {
            Element::Number(number) => Array::Numbers(self.numbers(*number, length)?),
            Element::String(bound) => {
                Array::Strings(self.several(length, 4, |reader| reader.text(*bound))?)
            }
            Element::WString(bound) => {
                Array::Strings(self.several(length, 4, |reader| reader.wide_text(*bound))?)
            }
            Element::Time => Array::Times(self.several(length, 8, Self::time)?),
            Element::Duration => Array::Durations(self.several(length, 8, Self::duration)?),
            Element::Nested(layout) => {
                if length > limits::RECORDS - self.records {
                    return Err(DecodeError::Records);
                }
                // A record has at least one byte.
                Array::Records(self.several(length, 1, |reader| reader.record(layout))?)
            }
        })
    }

    fn number(&mut self, number: NumberType) -> Result<Number> {
        self.align(number.size());
        let bytes = self.take(number.size())?;
        number.read(bytes, self.order).ok_or_else(|| self.short())
    }

    fn numbers(&mut self, number: NumberType, length: usize) -> Result<Numbers> {
        if length > 0 {
            self.align(number.size());
        }
        let size = length
            .checked_mul(number.size())
            .ok_or_else(|| self.short())?;
        let bytes = self.take(size)?;
        number
            .read_all(bytes, self.order)
            .ok_or_else(|| self.short())
    }

    /// Elements of at least `size` bytes each.
    fn several<T>(
        &mut self,
        length: usize,
        size: usize,
        read: impl Fn(&mut Self) -> Result<T>,
    ) -> Result<Vec<T>> {
        let left = self.body.len().saturating_sub(self.position);
        if length.checked_mul(size).is_none_or(|least| least > left) {
            return Err(self.short());
        }
        (0..length).map(|_| read(self)).collect()
    }

    /// With a zero at the end, which some leave out.
    fn text(&mut self, bound: Option<usize>) -> Result<Vec<u8>> {
        let length = self.count()?;
        let bytes = self.take(length)?;
        let text = bytes.strip_suffix(&[0]).unwrap_or(bytes);
        check_bound(text.len(), bound)?;
        Ok(text.to_vec())
    }

    fn wide_text(&mut self, bound: Option<usize>) -> Result<Vec<u8>> {
        let length = self.count()?;
        let bytes = self.take(length.checked_mul(2).ok_or_else(|| self.short())?)?;
        let unit = |pair: &[u8]| match self.order {
            ByteOrder::Little => u16::from_le_bytes([pair[0], pair[1]]),
            ByteOrder::Big => u16::from_be_bytes([pair[0], pair[1]]),
        };
        let units: Vec<u16> = bytes.chunks_exact(2).map(unit).collect();
        let text = String::from_utf16(&units)
            .map_err(|_| DecodeError::Text)?
            .into_bytes();
        check_bound(text.len(), bound)?;
        Ok(text)
    }

    fn time(&mut self) -> Result<Time> {
        Ok(Time {
            sec: self.word()?,
            nanosec: self.word()?,
        })
    }

    fn duration(&mut self) -> Result<Duration> {
        Ok(Duration {
            sec: self.word()?.cast_signed(),
            nanosec: self.word()?.cast_signed(),
        })
    }

    fn count(&mut self) -> Result<usize> {
        self.word().map(|word| word as usize)
    }

    fn word(&mut self) -> Result<u32> {
        match self.number(NumberType::UInt32)? {
            Number::UInt32(word) => Ok(word),
            _ => Err(self.short()),
        }
    }

    fn align(&mut self, size: usize) {
        self.position = self.position.next_multiple_of(size);
    }

    fn take(&mut self, length: usize) -> Result<&'a [u8]> {
        let end = self
            .position
            .checked_add(length)
            .ok_or_else(|| self.short())?;
        let bytes = self
            .body
            .get(self.position..end)
            .ok_or_else(|| self.short())?;
        self.position = end;
        Ok(bytes)
    }

    fn short(&self) -> DecodeError {
        DecodeError::Short {
            length: self.body.len() + 4,
        }
    }
}

fn check_bound(length: usize, bound: Option<usize>) -> Result<()> {
    match bound {
        Some(bound) if length > bound => Err(DecodeError::Bound { length, bound }),
        _ => Ok(()),
    }
}
