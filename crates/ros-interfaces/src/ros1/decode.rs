//! Bytes as records. Lengths are compared with what is there before memory is allocated.

use std::sync::Arc;

use crate::{
    Array, ByteOrder, DecodeError, Duration, Element, FieldType, Layout, NumberType, Record, Shape,
    Time, Value, limits,
};

type Result<T> = std::result::Result<T, DecodeError>;

/// Reads a record, to the last byte.
///
/// # Errors
/// If bytes are missing or left, or there are too many nested records.
pub fn decode(layout: &Arc<Layout>, bytes: &[u8]) -> Result<Record> {
    let mut reader = Reader {
        rest: bytes,
        length: bytes.len(),
        records: 0,
    };
    let record = reader.record(layout)?;
    if !reader.rest.is_empty() {
        return Err(DecodeError::Long {
            rest: reader.rest.len(),
        });
    }
    Ok(record)
}

struct Reader<'a> {
    rest: &'a [u8],
    /// Of the whole message.
    length: usize,
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
        Ok(Record::of_codec(layout, values.collect::<Result<_>>()?))
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
            Element::Number(number) => {
                let bytes = self.take(number.size())?;
                Value::Number(
                    number
                        .read(bytes, ByteOrder::Little)
                        .ok_or_else(|| self.short())?,
                )
            }
            Element::String(_) | Element::WString(_) => Value::String(self.string()?),
            Element::Time => Value::Time(self.time()?),
            Element::Duration => Value::Duration(self.duration()?),
            Element::Nested(layout) => Value::Record(self.record(layout)?),
        })
    }

    fn array(&mut self, element: &Element<Arc<Layout>>, length: usize) -> Result<Array> {
        Ok(match element {
            Element::Number(number) => Array::Numbers(self.numbers(*number, length)?),
            Element::String(_) | Element::WString(_) => {
                Array::Strings(self.several(length, 4, Self::string)?)
            }
            Element::Time => Array::Times(self.several(length, 8, Self::time)?),
            Element::Duration => Array::Durations(self.several(length, 8, Self::duration)?),
            Element::Nested(layout) => {
                if length > limits::RECORDS - self.records {
                    return Err(DecodeError::Records);
                }
                Array::Records(
                    self.several(length, layout.least_size, |reader| reader.record(layout))?,
                )
            }
        })
    }

    fn numbers(&mut self, number: NumberType, length: usize) -> Result<crate::Numbers> {
        let bytes = length
            .checked_mul(number.size())
            .ok_or_else(|| self.short())?;
        let bytes = self.take(bytes)?;
        number
            .read_all(bytes, ByteOrder::Little)
            .ok_or_else(|| self.short())
    }

    /// Elements of at least `size` bytes each.
    fn several<T>(
        &mut self,
        length: usize,
        size: usize,
        read: impl Fn(&mut Self) -> Result<T>,
    ) -> Result<Vec<T>> {
        if length
            .checked_mul(size)
            .is_none_or(|least| least > self.rest.len())
        {
            return Err(self.short());
        }
        (0..length).map(|_| read(self)).collect()
    }

    fn string(&mut self) -> Result<Vec<u8>> {
        let length = self.count()?;
        Ok(self.take(length)?.to_vec())
    }

    fn time(&mut self) -> Result<Time> {
        Ok(Time {
            sec: u32::from_le_bytes(self.word()?),
            nanosec: u32::from_le_bytes(self.word()?),
        })
    }

    fn duration(&mut self) -> Result<Duration> {
        Ok(Duration {
            sec: i32::from_le_bytes(self.word()?),
            nanosec: i32::from_le_bytes(self.word()?),
        })
    }

    fn count(&mut self) -> Result<usize> {
        Ok(u32::from_le_bytes(self.word()?) as usize)
    }

    fn word(&mut self) -> Result<[u8; 4]> {
        let bytes = self.take(4)?;
        bytes.first_chunk().copied().ok_or_else(|| self.short())
    }

    fn take(&mut self, length: usize) -> Result<&'a [u8]> {
        let (bytes, rest) = self
            .rest
            .split_at_checked(length)
            .ok_or_else(|| self.short())?;
        self.rest = rest;
        Ok(bytes)
    }

    fn short(&self) -> DecodeError {
        DecodeError::Short {
            length: self.length,
        }
    }
}
