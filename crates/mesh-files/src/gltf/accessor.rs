//! Accessors: typed numbers in buffer views, with sparse changes.

use serde_json::Value;

use super::{Reader, integer, item, list, refused, string};
use crate::error::Result;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn of(code: Option<u64>) -> Option<Self> {
        Some(match code? {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The number at the start of a slice of at least as many bytes. A normalized integer is a share of its largest value.
    fn read(self, bytes: &[u8], normalized: bool) -> f64 {
        let (value, largest) = match self {
            Self::I8 => (f64::from(bytes[0].cast_signed()), 127.0),
            Self::U8 => (f64::from(bytes[0]), 255.0),
            Self::I16 => (f64::from(i16::from_le_bytes([bytes[0], bytes[1]])), 32767.0),
            Self::U16 => (f64::from(u16::from_le_bytes([bytes[0], bytes[1]])), 65535.0),
            Self::U32 => (
                f64::from(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])),
                4_294_967_295.0,
            ),
            Self::F32 => {
                return f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]));
            }
        };
        if normalized {
            (value / largest).max(-1.0)
        } else {
            value
        }
    }
}

/// Rows of equal components in a slice.
struct Rows<'a> {
    bytes: &'a [u8],
    stride: usize,
    component: Component,
    normalized: bool,
}

impl Rows<'_> {
    fn row<const N: usize>(&self, row: usize) -> [f64; N] {
        let start = row * self.stride;
        std::array::from_fn(|k| {
            self.component.read(
                &self.bytes[start + k * self.component.bytes()..],
                self.normalized,
            )
        })
    }
}

impl Reader<'_, '_> {
    /// The rows of an accessor of `N` components each.
    pub(super) fn accessor<const N: usize>(&self, index: usize) -> Result<Vec<[f64; N]>> {
        let accessor = item(self.root, "accessors", index)?;
        let element = format!("accessor {index}");
        let expected = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        if string(accessor, "type") != Some(expected) {
            return Err(refused(element, format!("type is not {expected}")));
        }
        let count =
            integer(accessor, "count", &element)?.ok_or_else(|| refused(&element, "no count"))?;
        // Without a view, all are zeros until sparse changes: nothing else bounds the count then.
        if count
            > self
                .limits
                .vertices
                .max(self.limits.triangles.saturating_mul(3))
        {
            return Err(refused(
                element,
                format!("{count} rows are more than the limit"),
            ));
        }
        let mut values = match self.rows(accessor, count, N, &element)? {
            Some(rows) => (0..count).map(|row| rows.row(row)).collect(),
            None => vec![[0.0; N]; count],
        };
        if let Some(sparse) = accessor.get("sparse") {
            self.change(&mut values, accessor, sparse, &element)?;
        }
        Ok(values)
    }

    fn rows(
        &self,
        accessor: &Value,
        count: usize,
        components: usize,
        element: &str,
    ) -> Result<Option<Rows<'_>>> {
        let component = Component::of(accessor.get("componentType").and_then(Value::as_u64));
        let component = component.ok_or_else(|| refused(element, "unknown componentType"))?;
        let Some(view) = integer(accessor, "bufferView", element)? else {
            return Ok(None);
        };
        let (bytes, stride) = self.buffers.view(self.root, view)?;
        let size = components * component.bytes();
        let stride = stride.unwrap_or(size);
        let start = integer(accessor, "byteOffset", element)?.unwrap_or(0);
        let end = count.checked_sub(1).map_or(Some(start), |last| {
            last.checked_mul(stride)?
                .checked_add(start)?
                .checked_add(size)
        });
        let bytes = end.and_then(|end| bytes.get(start..end));
        let bytes = bytes.ok_or_else(|| {
            refused(
                element,
                format!("{count} rows do not fit into bufferView {view}"),
            )
        })?;
        let normalized = accessor
            .get("normalized")
            .and_then(Value::as_bool)
            .unwrap_or(false);
        Ok(Some(Rows {
            bytes,
            stride,
            component,
            normalized,
        }))
    }

    /// Rows that differ from the buffer view: their numbers and their values.
    fn change<const N: usize>(
        &self,
        values: &mut [[f64; N]],
        accessor: &Value,
        sparse: &Value,
        element: &str,
    ) -> Result<()> {
        let count = integer(sparse, "count", element)?.unwrap_or(0);
        // The values have the component type of the accessor.
        let Value::Object(mut whole) = sparse["values"].clone() else {
            return Err(refused(element, "sparse without values"));
        };
        whole.insert("componentType".into(), accessor["componentType"].clone());
        let whole = Value::Object(whole);
        let (indices, changes) = (
            self.rows(&sparse["indices"], count, 1, element)?,
            self.rows(&whole, count, N, element)?,
        );
        let Some((indices, changes)) = indices.zip(changes) else {
            return Err(refused(element, "sparse without a bufferView"));
        };
        for number in 0..count {
            let [row] = indices.row::<1>(number);
            let value = values
                .get_mut(numbers::index(row))
                .ok_or_else(|| refused(element, format!("sparse row {row} is not there")))?;
            *value = changes.row(number);
        }
        Ok(())
    }

    /// How many rows an accessor announces.
    pub(super) fn rows_of(&self, index: usize) -> usize {
        list(self.root, "accessors")
            .get(index)
            .and_then(|accessor| accessor.get("count")?.as_u64())
            .map_or(0, |count| usize::try_from(count).unwrap_or(usize::MAX))
    }
}
