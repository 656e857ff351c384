//! Custom data of objects and scenes, in their old and new layout.

use crate::ttt::chunks::{CustomData as Chunk, OldCustomData};
use crate::ttt::{Text, decode};
use scene::{CustomData, Data, Edit, ValueType};
use wire::pack;

/// The number under which old files keep named blocks.
const PACKED_TAGS: i32 = 356_248_756;

/// Takes the blocks of the new layout, or else those of the old one: the numbers of these become tags that begin with `prefix`.
pub(super) fn fill(
    data: &mut CustomData,
    new: Option<&Chunk>,
    old: Option<&OldCustomData>,
    prefix: &str,
) {
    let new = new.map(|chunk| chunk.blocks.as_slice()).unwrap_or_default();
    for (tag, block) in new {
        put(data, &tag.decode(), &block.0);
    }
    if !new.is_empty() {
        return;
    }
    for (number, Text(block)) in old.iter().flat_map(|chunk| &chunk.blocks) {
        if *number == PACKED_TAGS {
            packed_tags(block).for_each(|(tag, block)| put(data, &tag, block));
        } else {
            put(data, &format!("{prefix}{number}_"), block);
        }
    }
}

fn put(data: &mut CustomData, tag: &str, block: &[u8]) {
    let (ty, _) = ValueType::split_tag(tag);
    let value = value(ty, block).unwrap_or_else(|| Data::Buffer(block.to_vec()));
    data.edit(Edit::Tag(tag, Some(value)));
}

/// Entries of a size, the length of a name with its final zero, the name, and data. A list that lies ends where it does.
fn packed_tags(mut list: &[u8]) -> impl Iterator<Item = (String, &[u8])> {
    std::iter::from_fn(move || {
        let size = usize::try_from(int(list)?).ok()?;
        let (entry, rest) = list.get(4..)?.split_at_checked(size.checked_sub(4)?)?;
        list = rest;
        let length = usize::try_from(int(entry)?).ok()?;
        let (name, block) = entry.get(4..)?.split_at_checked(length)?;
        Some((decode(name.strip_suffix(&[0]).unwrap_or(name)), block))
    })
}

fn int(bytes: &[u8]) -> Option<i32> {
    bytes.first_chunk().map(|bytes| i32::from_le_bytes(*bytes))
}

/// A value of a type by the mark of its tag.
fn value(ty: ValueType, block: &[u8]) -> Option<Data> {
    let float = |bytes: &[u8]| bytes.try_into().ok().map(f64::from_le_bytes);
    let whole = |bytes: &[u8]| match bytes.len() {
        4 => int(bytes).map(i64::from),
        _ => bytes.try_into().ok().map(i64::from_le_bytes),
    };
    let list = |items: Option<Vec<Data>>| items.map(Data::Array);
    Some(match ty {
        ValueType::Buffer => return None,
        ValueType::String => Data::Text(block.to_vec()),
        ValueType::Table => pack::decode(block).ok()?,
        ValueType::Bool => Data::Bool(block.iter().any(|byte| *byte != 0)),
        ValueType::Int | ValueType::Long => Data::Int(whole(block)?),
        ValueType::Float => Data::Float(float(block)?),
        ValueType::IntArray | ValueType::IntArray2 => {
            list(block.chunks(4).map(|c| whole(c).map(Data::Int)).collect())?
        }
        ValueType::Color if block.len() == 12 => {
            let (parts, _) = block.as_chunks::<4>();
            Data::Array(
                parts
                    .iter()
                    .map(|c| Data::Float(f32::from_le_bytes(*c).into()))
                    .collect(),
            )
        }
        _ => list(block.chunks(8).map(|c| float(c).map(Data::Float)).collect())?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_under_numbers_get_names() {
        let mut packed = Vec::new();
        packed.extend(16i32.to_le_bytes());
        packed.extend(3i32.to_le_bytes());
        packed.extend(b"ab\0data.");
        let old = OldCustomData {
            blocks: vec![(7, Text(b"seven".to_vec())), (PACKED_TAGS, Text(packed))],
        };
        let mut data = CustomData::default();
        fill(&mut data, None, Some(&old), "_old_");
        assert_eq!(data.get("_old_7_"), Some(&Data::Buffer(b"seven".to_vec())));
        assert_eq!(data.get("ab"), Some(&Data::Buffer(b"data.".to_vec())));
    }

    #[test]
    fn lists_that_lie_end() {
        for size in [i32::MIN, -1, 0, 3, 5, i32::MAX] {
            assert_eq!(
                packed_tags(&[size.to_le_bytes(), size.to_le_bytes()].concat()).count(),
                0
            );
        }
    }

    #[test]
    fn typed_values_are_understood() {
        let chunk = Chunk {
            blocks: vec![
                ("&dbl&.x".into(), Text(2.5f64.to_le_bytes().to_vec())),
                ("&int&.n".into(), Text(vec![7, 0, 0, 0])),
            ],
        };
        let mut data = CustomData::default();
        fill(&mut data, Some(&chunk), None, "");
        assert_eq!(data.typed("x"), Some((ValueType::Float, &Data::Float(2.5))));
        assert_eq!(data.typed("n"), Some((ValueType::Int, &Data::Int(7))));
    }
}
