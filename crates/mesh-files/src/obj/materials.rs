//! MTL: colours, transparency and the texture of the diffuse colour.

use std::collections::BTreeMap;

use crate::Resolve;
use crate::mesh_file::{Material, Texture};
use crate::text::{file_name, name, number, number_or_zero, words};

/// The materials of all libraries that a file names.
#[derive(Default)]
pub(super) struct Library {
    materials: BTreeMap<Vec<u8>, Material>,
    by_path: BTreeMap<String, Option<usize>>,
    loaded: Vec<String>,
    pub(super) textures: Vec<Texture>,
    pub(super) warnings: Vec<String>,
}

/// More libraries than this are not looked up: each is a file that is opened.
const MAX_LIBRARIES: usize = 100;

impl Library {
    /// What is known of a material; one that no library defines has only its name.
    pub(super) fn material(&self, key: &[u8]) -> Material {
        let unknown = || Material {
            name: name(key),
            ..Material::default()
        };
        self.materials.get(key).cloned().unwrap_or_else(unknown)
    }

    /// Reads a library; if it cannot be had, that is a warning.
    pub(super) fn load(&mut self, path: &[u8], resolve: Resolve) {
        let path = name(path);
        if path.is_empty() || self.loaded.contains(&path) || self.loaded.len() >= MAX_LIBRARIES {
            return;
        }
        self.loaded.push(path.clone());
        match resolve(&path) {
            Ok(text) => self.read(&text, resolve),
            Err(why) => self.warnings.push(format!("materials {path}: {why}")),
        }
    }

    fn read(&mut self, text: &[u8], resolve: Resolve) {
        let mut current = None;
        for line in text.split(|&byte| byte == b'\n') {
            let line = line.trim_ascii();
            let end = line
                .iter()
                .position(u8::is_ascii_whitespace)
                .unwrap_or(line.len());
            let (keyword, rest) = (&line[..end], line[end..].trim_ascii());
            if keyword == b"newmtl" {
                let material = Material {
                    name: name(rest),
                    ..Material::default()
                };
                self.materials.insert(rest.to_vec(), material);
                current = Some(rest.to_vec());
            } else if let Some(key) = &current {
                self.property(key, keyword, rest, resolve);
            }
        }
    }

    fn property(&mut self, key: &[u8], keyword: &[u8], rest: &[u8], resolve: Resolve) {
        let texture = if keyword.eq_ignore_ascii_case(b"map_Kd") {
            self.texture(rest, resolve)
        } else {
            None
        };
        let Some(material) = self.materials.get_mut(key) else {
            return;
        };
        let share = || number_or_zero(words(rest).next()).clamp(0.0, 1.0);
        match keyword {
            b"Kd" => material.diffuse = colour(rest),
            b"Ks" => material.specular = colour(rest),
            b"Ke" => material.emission = colour(rest),
            b"d" => {
                material.transparency =
                    1.0 - words(rest).find_map(number).unwrap_or(1.0).clamp(0.0, 1.0);
            }
            b"Tr" => material.transparency = share(),
            _ if texture.is_some() => material.texture = texture,
            _ => {}
        }
    }

    /// The texture of a `map_Kd` line: its options go, the rest is the name, which may contain spaces.
    fn texture(&mut self, rest: &[u8], resolve: Resolve) -> Option<usize> {
        let path = without_options(rest);
        if path.is_empty() {
            return None;
        }
        if let Some(known) = self.by_path.get(&path) {
            return *known;
        }
        let found = match resolve(&path) {
            Ok(bytes) => {
                self.textures.push(Texture {
                    name: file_name(&path).into(),
                    bytes,
                });
                Some(self.textures.len() - 1)
            }
            Err(why) => {
                self.warnings.push(format!("texture {path}: {why}"));
                None
            }
        };
        self.by_path.insert(path, found);
        found
    }
}

/// Three shares, or one for all three; `spectral` and `xyz` colours are left out.
fn colour(rest: &[u8]) -> Option<[f64; 3]> {
    let shares: Vec<f64> = words(rest)
        .map_while(number)
        .take(3)
        .map(|x| x.clamp(0.0, 1.0))
        .collect();
    match shares[..] {
        [grey] => Some([grey; 3]),
        [red, green, blue] => Some([red, green, blue]),
        _ => None,
    }
}

/// Options are `-name` and their values: numbers, `on`, `off` or a channel.
fn without_options(rest: &[u8]) -> String {
    let mut left = rest;
    while left.starts_with(b"-") {
        left = skip_word(left);
        while let Some(word) = words(left).next()
            && (number(word).is_some()
                || [&b"on"[..], b"off", b"r", b"g", b"b", b"m", b"l", b"z"].contains(&word))
            && words(left).nth(1).is_some()
        {
            left = skip_word(left);
        }
    }
    name(left)
}

fn skip_word(line: &[u8]) -> &[u8] {
    let end = line
        .iter()
        .position(u8::is_ascii_whitespace)
        .unwrap_or(line.len());
    line[end..].trim_ascii_start()
}
