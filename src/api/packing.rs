//! `sim.*`: values as bytes: lists of numbers in little-endian order, and tables.
//!
//! Both packing schemes of tables are CBOR here; data packed by CoppeliaSim with its own scheme 0 is refused.

use api_macro::api;

use super::{ApiFn, Cx, Result, functions};
use crate::scene::{Data, SceneError};
use crate::script::{Bytes, Number, Table};
use crate::wire::cbor;

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
];

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
            let bytes: Vec<u8> = numbers.iter().flat_map(|&number| (number as $stored).to_le_bytes()).collect();
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
/// @param scheme 0 or 1
/// @return data
#[api("sim.packTable")]
fn pack_table(_cx: &Cx, a_table: Table, #[default(0)] _scheme: Number) -> Result<Bytes> {
    Ok(Bytes(cbor::encode(&a_table.0)))
}

/// Unpacks a table.
///
/// @param data what sim.packTable gave, or other CBOR
/// @param scheme the encoding is recognised without it
/// @return aTable
#[api("sim.unpackTable")]
fn unpack_table(_cx: &Cx, data: Bytes, #[default(0)] _scheme: Number) -> Result<Data> {
    Ok(cbor::decode(&data.0).map_err(|_| SceneError::InvalidData)?)
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
