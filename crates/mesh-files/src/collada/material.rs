//! Materials: the effect's colours, transparency and diffuse texture.

use std::collections::HashMap;

use bounded_xml::Node;

use super::{Elements, Reader};
use crate::error::Result;
use crate::mesh_file::{Material, Texture};
use crate::text::{file_name, number, percent_decoded};

/// What was looked up already. Never iterated.
#[derive(Default)]
pub(super) struct Materials {
    known: HashMap<bounded_xml::NodeId, Material>,
    textures: HashMap<String, Option<usize>>,
}

impl<'a> Reader<'a, '_> {
    /// The material of an element `material`.
    pub(super) fn material(&mut self, node: Node<'a, 'a>) -> Result<Material> {
        if let Some(known) = self.materials.known.get(&node.id()) {
            return Ok(known.clone());
        }
        let name = node
            .attribute("name")
            .or(node.attribute("id"))
            .unwrap_or("");
        let mut material = Material {
            name: name.into(),
            ..Material::default()
        };
        let effect = node
            .first("instance_effect")
            .and_then(|instance| self.target(instance.attribute("url")?));
        if let Some(profile) = effect.and_then(|effect| effect.first("profile_COMMON")) {
            self.profile(profile, &mut material);
        }
        self.materials.known.insert(node.id(), material.clone());
        Ok(material)
    }

    fn profile(&mut self, profile: Node<'a, 'a>, material: &mut Material) {
        let shading = profile.first("technique").and_then(|technique| {
            let is_shading = |node: &Node| {
                ["phong", "lambert", "blinn", "constant"].contains(&node.tag_name().name())
            };
            technique.children().find(is_shading)
        });
        let Some(shading) = shading else { return };
        material.diffuse = colour(shading.first("diffuse")).map(rgb);
        material.specular = colour(shading.first("specular")).map(rgb);
        material.emission = colour(shading.first("emission")).map(rgb);
        material.transparency = transparency(shading);
        let texture = shading
            .first("diffuse")
            .and_then(|diffuse| diffuse.first("texture")?.attribute("texture"));
        material.texture = texture.and_then(|sampler| self.texture(profile, sampler));
    }

    /// A texture by the name of its sampler: sampler, surface, image; exporters also name the image at once.
    fn texture(&mut self, profile: Node<'a, 'a>, sampler: &str) -> Option<usize> {
        let parameter = |sid: &str| {
            profile
                .all("newparam")
                .find(|node| node.attribute("sid") == Some(sid))
        };
        let sampler_2d = parameter(sampler).and_then(|node| node.first("sampler2D"));
        let surface = sampler_2d
            .and_then(|node| parameter(node.first("source")?.content())?.first("surface"));
        let instance = sampler_2d
            .and_then(|node| self.target(node.first("instance_image")?.attribute("url")?));
        let named = surface
            .and_then(|surface| self.ids.get(surface.first("init_from")?.content()).copied());
        let image = instance
            .or(named)
            .or_else(|| self.ids.get(sampler).copied())?;
        let from = image.first("init_from")?;
        let path = from.first("ref").unwrap_or(from).content();
        self.load_texture(percent_decoded(
            path.strip_prefix("file://").unwrap_or(path),
        ))
    }

    fn load_texture(&mut self, path: String) -> Option<usize> {
        if path.is_empty() {
            return None;
        }
        if let Some(known) = self.materials.textures.get(&path) {
            return *known;
        }
        let found = match (self.resolve)(&path) {
            Ok(bytes) => {
                self.file.textures.push(Texture {
                    name: file_name(&path).into(),
                    bytes,
                });
                Some(self.file.textures.len() - 1)
            }
            Err(why) => {
                self.file.warnings.push(format!("texture {path}: {why}"));
                None
            }
        };
        self.materials.textures.insert(path, found);
        found
    }
}

/// Red, green, blue and opacity, from 0 to 1.
fn colour(node: Option<Node>) -> Option<[f64; 4]> {
    let text = node?
        .children()
        .find(|child| child.tag_name().name() == "color")?
        .text()?;
    let shares: Vec<f64> = text
        .split_ascii_whitespace()
        .map_while(|word| number(word.as_bytes()))
        .map(|x| x.clamp(0.0, 1.0))
        .collect();
    match shares[..] {
        [red, green, blue] => Some([red, green, blue, 1.0]),
        [red, green, blue, alpha, ..] => Some([red, green, blue, alpha]),
        _ => None,
    }
}

fn rgb([red, green, blue, _]: [f64; 4]) -> [f64; 3] {
    [red, green, blue]
}

/// `transparent` and `transparency` by the rules A_ONE and RGB_ZERO. Exporters disagree about which end of the range is opaque, so what
/// would be invisible is taken as opaque.
fn transparency(shading: Node) -> f64 {
    let child = |name: &str| {
        shading
            .children()
            .find(|child| child.tag_name().name() == name)
    };
    let factor = child("transparency")
        .and_then(|node| {
            node.children()
                .find(|child| child.tag_name().name() == "float")
        })
        .and_then(|node| number(node.text()?.trim().as_bytes()))
        .unwrap_or(1.0)
        .clamp(0.0, 1.0);
    let transparent = child("transparent");
    let is_zero_mode = transparent.and_then(|node| node.attribute("opaque")) == Some("RGB_ZERO");
    let [red, green, blue, alpha] = colour(transparent).unwrap_or([1.0; 4]);
    // The luminance of linear red, green and blue (ITU-R BT.709).
    let luminance = 0.212671 * red + 0.715160 * green + 0.072169 * blue;
    let transparency = if is_zero_mode {
        luminance * factor
    } else {
        1.0 - alpha * factor
    };
    if transparency > 0.999 {
        0.0
    } else {
        transparency
    }
}
