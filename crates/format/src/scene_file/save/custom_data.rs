//! Custom data as bytes: the inverse of loading.

use crate::ttt::Text;
use crate::ttt::chunks::CustomData as Chunk;
use scene::{CustomData, Data, ValueType};
use wire::pack;

/// Nothing where there is no data: the chunk is left out then.
pub(super) fn chunk(data: &CustomData) -> Option<Chunk> {
    let block = |tag: String| {
        let (ty, _) = ValueType::split_tag(&tag);
        let bytes = bytes(ty, data.get(&tag)?)?;
        Some((tag.as_str().into(), Text(bytes)))
    };
    let blocks: Vec<(Text, Text)> = data.tags().filter_map(block).collect();
    (!blocks.is_empty()).then_some(Chunk { blocks })
}

/// None for what has no bytes, such as a table with a function in it.
fn bytes(ty: ValueType, value: &Data) -> Option<Vec<u8>> {
    Some(match value {
        Data::Buffer(bytes) | Data::Text(bytes) => bytes.clone(),
        _ if ty == ValueType::Table => pack::encode(value)?,
        Data::Bool(on) => vec![u8::from(*on)],
        Data::Int(int) if ty == ValueType::Long => int.to_le_bytes().to_vec(),
        Data::Int(int) => i32::try_from(*int)
            .map_or_else(|_| int.to_le_bytes().to_vec(), |i| i.to_le_bytes().to_vec()),
        Data::Float(float) => float.to_le_bytes().to_vec(),
        Data::Array(items) => items
            .iter()
            .map(|item| element(ty, item))
            .collect::<Option<Vec<_>>>()?
            .concat(),
        Data::Nil | Data::Map(_) => return None,
    })
}

fn element(ty: ValueType, item: &Data) -> Option<Vec<u8>> {
    let number = item.as_f64()?;
    Some(match ty {
        ValueType::IntArray | ValueType::IntArray2 => {
            numbers::truncated_i32(number).to_le_bytes().to_vec()
        }
        ValueType::Color => numbers::single(number).to_le_bytes().to_vec(),
        _ => number.to_le_bytes().to_vec(),
    })
}
