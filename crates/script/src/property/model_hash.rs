//! The hash of a model, equal for models with equal properties.

use std::rc::Rc;

use super::access::{Accessor, subject_properties};
use super::{PropertyTarget, Sim, flags};
use crate::error::ApiResult;
use scene::{Data, Handle, Key, Kind, Namespace, Uid};

pub(super) const MODEL_HASH: &[Accessor] = subject_properties! {
    "modelHash": String, |s| s.sim.model_hash(s.object()?)?;
};

/// FNV-1a with 128 bits (Fowler, Noll, Vo).
struct Fnv(u128);

impl Fnv {
    const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

    fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u128::from(byte)).wrapping_mul(Self::PRIME);
        }
    }

    /// A part of variable length, so that neighbouring parts do not run into each other.
    fn part(&mut self, mark: u8, bytes: &[u8]) {
        self.bytes(&[mark]);
        self.bytes(&(bytes.len() as u64).to_le_bytes());
        self.bytes(bytes);
    }

    fn data(&mut self, data: &Data) {
        match data {
            Data::Nil => self.bytes(b"n"),
            Data::Bool(on) => self.bytes(&[b'b', u8::from(*on)]),
            Data::Int(number) => self.part(b'i', &number.to_le_bytes()),
            Data::Float(number) => self.part(b'f', &number.to_bits().to_le_bytes()),
            Data::Text(text) => self.part(b't', text),
            Data::Buffer(bytes) => self.part(b'x', bytes),
            Data::Array(items) => {
                self.part(b'a', &(items.len() as u64).to_le_bytes());
                items.iter().for_each(|item| self.data(item));
            }
            Data::Map(entries) => {
                self.part(b'm', &(entries.len() as u64).to_le_bytes());
                for (key, value) in entries {
                    self.key(key);
                    self.data(value);
                }
            }
        }
    }

    fn key(&mut self, key: &Key) {
        match key {
            Key::Bool(on) => self.part(b'B', &[u8::from(*on)]),
            Key::Int(number) => self.part(b'I', &number.to_le_bytes()),
            Key::Float(number) => self.part(b'F', &number.to_bits().to_le_bytes()),
            Key::Text(text) => self.part(b'T', text),
        }
    }
}

impl Sim {
    /// The hash of the model that has this base; no text for objects that are no model base. Everything in the tree counts, with its
    /// custom data and meshes, but properties that are marked to be left out.
    fn model_hash(self: &Rc<Self>, base: Handle) -> ApiResult<String> {
        if !self.scene.borrow().object(base)?.is_model() {
            return Ok(String::new());
        }
        let mut hash = Fnv(Fnv::OFFSET);
        let members = self.scene.borrow().subtree(base);
        for &member in &members {
            self.hash_object(&mut hash, member, &members)?;
        }
        Ok(format!("{:032x}", hash.0))
    }

    fn hash_object(
        self: &Rc<Self>,
        hash: &mut Fnv,
        handle: Handle,
        members: &[Handle],
    ) -> ApiResult<()> {
        let (parent, meshes) = {
            let scene = self.scene.borrow();
            let object = scene.object(handle)?;
            let parent = object
                .parent()
                .and_then(|parent| members.iter().position(|&member| member == parent));
            (parent, mesh_uids(&object.kind))
        };
        hash.part(b'o', format!("{parent:?}").as_bytes());
        self.hash_rows(hash, &PropertyTarget::Object(handle))?;
        let custom_data = self.with_named_values(
            &PropertyTarget::Object(handle),
            Namespace::CustomData,
            |values| {
                values
                    .tags()
                    .map(|tag| (tag.clone(), values.get(&tag).cloned()))
                    .collect::<Vec<_>>()
            },
        )?;
        for (tag, value) in custom_data {
            hash.part(b'c', tag.as_bytes());
            hash.data(&value.unwrap_or(Data::Nil));
        }
        meshes
            .into_iter()
            .try_for_each(|uid| self.hash_rows(hash, &PropertyTarget::Mesh(uid)))
    }

    /// The static properties that count.
    fn hash_rows(self: &Rc<Self>, hash: &mut Fnv, target: &PropertyTarget) -> ApiResult<()> {
        let (before, after) = self.rows_of(target)?;
        let left_out = flags::MODEL_HASH_EXCLUDE | flags::NOT_READABLE | flags::DEPRECATED;
        for row in before
            .iter()
            .chain(after)
            .filter(|row| row.flags & left_out == 0)
        {
            hash.part(b'p', row.name.as_bytes());
            hash.data(&self.read_row(target, row)?);
        }
        Ok(())
    }
}

fn mesh_uids(kind: &Kind) -> Vec<Uid> {
    match kind {
        Kind::Shape(shape) => shape.parts.iter().map(|part| part.uid).collect(),
        _ => Vec::new(),
    }
}
