//! Strings with their length, and the obfuscated text of scripts.

use super::Value;
use crate::ttt::error::FileResult;
use crate::ttt::node::{Node, NodeResult};
use crate::ttt::read::{Reader, Real};
use crate::ttt::write::Writer;

/// A text or other bytes behind their length. Mostly UTF-8; names and scripts of old Windows programs are Latin-1.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Text(pub Vec<u8>);

impl Text {
    /// As UTF-8, or else as Latin-1.
    pub fn decode(&self) -> String {
        decode(&self.0)
    }
}

impl From<&str> for Text {
    fn from(text: &str) -> Self {
        Self(text.as_bytes().to_vec())
    }
}

/// Bytes as UTF-8, or as Latin-1 where they are not UTF-8.
pub fn decode(bytes: &[u8]) -> String {
    std::str::from_utf8(bytes).map_or_else(
        |_| bytes.iter().map(|b| char::from(*b)).collect(),
        str::to_owned,
    )
}

impl Value for Text {
    fn read(input: &mut Reader<'_>, _: Real) -> FileResult<Self> {
        let length = input.count(1)?;
        Ok(Self(input.take(length)?.to_vec()))
    }

    fn write(&self, out: &mut Writer) {
        out.int(numbers::count_i32(self.0.len()));
        out.bytes.extend(&self.0);
    }

    fn to_node(&self) -> Node {
        match std::str::from_utf8(&self.0) {
            Ok(text) => Node::Text(text.to_owned()),
            Err(_) => Node::Bytes(self.0.clone()),
        }
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        node.bytes().map(Self)
    }
}

/// The text of a script. Files hide it a little; here it is plain.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ScriptText(pub Vec<u8>);

impl Value for ScriptText {
    fn read(input: &mut Reader<'_>, _: Real) -> FileResult<Self> {
        let mut text = input.take_rest().to_vec();
        shift_text(&mut text, u8::wrapping_add);
        let length = text
            .iter()
            .rposition(|byte| *byte != 0)
            .map_or(0, |last| last + 1);
        text.truncate(length);
        Ok(Self(text))
    }

    fn write(&self, out: &mut Writer) {
        let mut text = self.0.clone();
        shift_text(&mut text, u8::wrapping_sub);
        out.bytes.extend(text);
    }

    fn to_node(&self) -> Node {
        Node::Script(self.0.clone())
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        node.bytes().map(Self)
    }
}

/// Moves every byte but the first and the last by a number that depends on its place and on these two.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the sum is taken modulo 256"
)]
fn shift_text(text: &mut [u8], shift: fn(u8, u8) -> u8) {
    let [first, middle @ .., last] = text else {
        return;
    };
    let start = i64::from((*first).cast_signed() / 2);
    let end = i64::from((*last).cast_signed()) * 3;
    for (i, byte) in (1i64..).zip(middle) {
        let terms = [
            (1, i + start + end),
            (2, -(3 * i + start)),
            (4, i / 2 + end),
        ];
        let amount: i64 = terms
            .iter()
            .filter(|(bit, _)| i & bit != 0)
            .map(|(_, term)| term)
            .sum();
        *byte = shift(*byte, amount as u8);
    }
}
