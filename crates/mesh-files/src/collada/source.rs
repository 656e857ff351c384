//! Sources: arrays of numbers, read in steps.

use std::rc::Rc;

use bounded_xml::Node;

use super::{Elements, Reader};
use crate::error::Result;
use crate::text::{no_number, quoted};

/// Rows of numbers.
pub(super) struct Source {
    values: Vec<f64>,
    first: usize,
    stride: usize,
    rows: usize,
}

impl Source {
    /// The first numbers of each row; what a row does not have is 0.
    pub(super) fn list<const N: usize>(&self) -> Vec<[f64; N]> {
        let used = N.min(self.stride);
        // Accessors of real files announce too many rows now and then: the array counts. Its last row may be short.
        let whole = self
            .values
            .len()
            .saturating_sub(self.first)
            .checked_sub(used)
            .map_or(0, |rest| rest / self.stride + 1);
        (0..self.rows.min(whole))
            .map(|row| {
                let start = self.first + row * self.stride;
                let mut list = [0.0; N];
                list[..used].copy_from_slice(&self.values[start..start + used]);
                list
            })
            .collect()
    }
}

impl<'a> Reader<'a, '_> {
    /// The source that an input names.
    pub(super) fn source(&mut self, input: Node<'a, 'a>) -> Result<Rc<Source>> {
        let node = self.referred(input, "source")?;
        if let Some(known) = self.sources.get(&node.id()) {
            return Ok(known.clone());
        }
        let source = Rc::new(self.read_source(node)?);
        self.sources.insert(node.id(), source.clone());
        Ok(source)
    }

    fn read_source(&self, node: Node<'a, 'a>) -> Result<Source> {
        let Some(array) = node.first("float_array") else {
            return Err(self.refused(node, "no float_array"));
        };
        let mut values = Vec::new();
        for word in array.text().unwrap_or("").split_ascii_whitespace() {
            // Programs write `NaN` for normals and texture coordinates that they could not compute. Positions are checked at the end.
            let value = word
                .parse()
                .map_err(|_| self.refused(array, no_number(Some(word.as_bytes()))))?;
            values.push(value);
        }
        let accessor = node
            .first("technique_common")
            .and_then(|technique| technique.first("accessor"));
        let integer = |name: &str, default: usize| match accessor
            .and_then(|accessor| accessor.attribute(name))
        {
            None => Ok(default),
            Some(text) => text.trim().parse().map_err(|_| {
                self.refused(
                    array,
                    format!("{name} {} is no count", quoted(text.as_bytes())),
                )
            }),
        };
        let (first, stride) = (integer("offset", 0)?, integer("stride", 3)?.max(1));
        let rows = integer("count", usize::MAX)?;
        Ok(Source {
            values,
            first,
            stride,
            rows,
        })
    }
}
