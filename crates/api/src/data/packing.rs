//! `sim.*`: values as bytes: lists of numbers in little-endian order, tables, and buffers in other formats.

use api_macro::api;
use base64::Engine;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::{Data, SceneError};
use script::{Bytes, Number, Table};
use wire::number_buffer::{Format, Mapping, transform};
use wire::{cbor, pack};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    pack_int32_table,
    unpack_int32_table,
    pack_int64_table,
    unpack_int64_table,
    pack_u_int32_table,
    unpack_u_int32_table,
    pack_u_int16_table,
    unpack_u_int16_table,
    pack_u_int8_table,
    unpack_u_int8_table,
    pack_float_table,
    unpack_float_table,
    pack_double_table,
    unpack_double_table,
    pack_table,
    unpack_table,
    transform_buffer,
];

/// The packing scheme of tables that is CBOR; scheme 0 is CoppeliaSim's own.
const CBOR: i64 = 1;

/// Values of `sim.buffer_*` that are no format of numbers.
mod format {
    pub const BASE64: i64 = 12;
    pub const SPLIT: i64 = 13;
    pub const CLAMP: i64 = 0x100;
}

/// No buffer a script gets is larger, bytes.
const MAX_BUFFER: usize = 1 << 29;

/// No buffer is split into more parts.
const MAX_PARTS: usize = 1 << 20;

/// `count` items of a list beginning with number `start`; all to its end when `count` is 0.
fn range<T>(list: &[T], start: i64, count: i64) -> &[T] {
    let start = usize::try_from(start).unwrap_or(0).min(list.len());
    let rest = &list[start..];
    match usize::try_from(count) {
        Ok(count) if count > 0 => &rest[..count.min(rest.len())],
        _ => rest,
    }
}

/// The part of `data` from byte `offset` on.
fn after(data: &[u8], offset: i64) -> &[u8] {
    &data[usize::try_from(offset).unwrap_or(0).min(data.len())..]
}

/// Packing and unpacking of one type: numbers as scripts have them, and as they are stored.
macro_rules! number_lists {
    ($($pack:ident $pack_name:tt, $unpack:ident $unpack_name:tt, $item:ty as $stored:ty;)*) => { $(
        /// Packs numbers into bytes; those that do not fit are cut as in C.
        ///
        /// @param numbers the list
        /// @param startIndex number of the first item, from 0
        /// @param count how many; 0: all
        /// @return data nothing for an empty list
        #[api($pack_name)]
        fn $pack(
            _cx: &Cx, numbers: Vec<$item>, #[default(0)] start_index: Number, #[default(0)] count: Number,
        ) -> Result<Option<Bytes>> {
            let numbers = range(&numbers, start_index.0, count.0);
            let bytes = numbers.iter().map(|&number| (number as $stored).to_le_bytes());
            let bytes = bytes.collect::<Vec<_>>().into_flattened();
            Ok((!bytes.is_empty()).then_some(Bytes(bytes)))
        }

        /// Unpacks numbers from bytes.
        ///
        /// @param data the bytes
        /// @param startIndex number of the first item, from 0
        /// @param count how many; 0: all
        /// @param additionalByteOffset bytes to skip first
        /// @return numbers
        #[api($unpack_name)]
        fn $unpack(
            _cx: &Cx, data: Bytes, #[default(0)] start_index: Number, #[default(0)] count: Number,
            #[default(0)] additional_byte_offset: Number,
        ) -> Result<Vec<$item>> {
            let (items, _) = after(&data.0, additional_byte_offset.0).as_chunks();
            let items = range(items, start_index.0, count.0);
            Ok(items.iter().map(|&bytes| <$stored>::from_le_bytes(bytes) as $item).collect())
        }
    )* };
}

number_lists! {
    pack_int32_table "sim.packInt32Table", unpack_int32_table "sim.unpackInt32Table", i64 as i32;
    pack_int64_table "sim.packInt64Table", unpack_int64_table "sim.unpackInt64Table", i64 as i64;
    pack_u_int32_table "sim.packUInt32Table", unpack_u_int32_table "sim.unpackUInt32Table", i64 as u32;
    pack_u_int16_table "sim.packUInt16Table", unpack_u_int16_table "sim.unpackUInt16Table", i64 as u16;
    pack_u_int8_table "sim.packUInt8Table", unpack_u_int8_table "sim.unpackUInt8Table", i64 as u8;
    pack_float_table "sim.packFloatTable", unpack_float_table "sim.unpackFloatTable", f64 as f32;
    pack_double_table "sim.packDoubleTable", unpack_double_table "sim.unpackDoubleTable", f64 as f64;
}

/// Packs a table into bytes.
///
/// @param aTable any values; functions become texts
/// @param scheme 0: CoppeliaSim's own encoding, 1: CBOR
/// @return data
#[api("sim.packTable")]
fn pack_table(_cx: &Cx, a_table: Table, #[default(0)] scheme: Number) -> Result<Bytes> {
    match scheme.0 {
        CBOR => Ok(Bytes(cbor::encode(&a_table.0))),
        _ => pack::encode(&a_table.0).map(Bytes).ok_or_else(too_large),
    }
}

/// Unpacks a table.
///
/// @param data what sim.packTable gave, here or in CoppeliaSim, or other CBOR
/// @param scheme the encoding is recognised without it
/// @return aTable
#[api("sim.unpackTable")]
fn unpack_table(_cx: &Cx, data: Bytes, #[default(0)] _scheme: Number) -> Result<Data> {
    let table = if pack::is_packed(&data.0) {
        pack::decode(&data.0)
    } else {
        cbor::decode(&data.0)
    };
    table.map_err(|why| ApiError::Other(why.to_string()))
}

/// Converts a buffer of numbers or pixels to another format; each number becomes number * multiplier + offset.
///
/// @param inBuffer numbers or pixels
/// @param inFormat sim.buffer_*, their format; sim.buffer_base64: text to be decoded
/// @param multiplier not of alpha
/// @param offset not of alpha; with sim.buffer_split: bytes per part
/// @param outFormat sim.buffer_*, with sim.buffer_clamp added: numbers are cut to the range of the format; sim.buffer_base64: text;
/// sim.buffer_split: a list of buffers
/// @return outBuffer
#[api("sim.transformBuffer")]
fn transform_buffer(
    _cx: &Cx,
    in_buffer: Bytes,
    in_format: Number,
    multiplier: f64,
    offset: f64,
    out_format: Number,
) -> Result<Data> {
    let mapping = Mapping {
        multiplier,
        offset,
        clamp: out_format.0 & format::CLAMP != 0,
    };
    let (bytes, from) = match in_format.0 {
        format::BASE64 => (from_base64(&in_buffer.0)?, Format::U8),
        number => (in_buffer.0, number_format(number)?),
    };
    match out_format.0 & !format::CLAMP {
        format::SPLIT => split(&bytes, offset),
        format::BASE64 => Ok(Data::Buffer(
            base64::prelude::BASE64_STANDARD.encode(bytes).into_bytes(),
        )),
        number => convert(&bytes, from, mapping, number_format(number)?),
    }
}

fn convert(bytes: &[u8], from: Format, mapping: Mapping, to: Format) -> Result<Data> {
    if bytes.len() / from.size() > MAX_BUFFER / to.size() {
        return Err(too_large());
    }
    let out = transform(bytes, from, mapping, to);
    Ok(Data::Buffer(out.ok_or_else(|| {
        ApiError::Other("incorrect buffer size.".into())
    })?))
}

fn number_format(number: i64) -> Result<Format> {
    Ok(Format::from_number(number).ok_or(SceneError::InvalidArgument)?)
}

fn from_base64(text: &[u8]) -> Result<Vec<u8>> {
    Ok(base64::prelude::BASE64_STANDARD
        .decode(text)
        .map_err(|_| SceneError::InvalidData)?)
}

/// Parts of `size` bytes; the last one may be shorter.
fn split(bytes: &[u8], size: f64) -> Result<Data> {
    match numbers::index(size) {
        0 => Err(SceneError::InvalidArgument.into()),
        size if bytes.len().div_ceil(size) > MAX_PARTS => Err(too_large()),
        size => Ok(Data::Array(
            bytes
                .chunks(size)
                .map(|part| Data::Buffer(part.to_vec()))
                .collect(),
        )),
    }
}

fn too_large() -> ApiError {
    ApiError::Other("the data is too large.".into())
}

#[cfg(test)]
mod tests {
    use super::{after, range};

    #[test]
    fn ranges_stay_within_the_list() {
        let list = [1, 2, 3];
        assert_eq!(range(&list, 1, 0), [2, 3]);
        assert_eq!(range(&list, 1, 1), [2]);
        assert!(range(&list, 9, 5).is_empty());
        assert_eq!(range(&list, -4, i64::MAX), [1, 2, 3]);
        assert!(after(&[1, 2], i64::MAX).is_empty());
    }
}
