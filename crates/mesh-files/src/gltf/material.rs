//! Materials: base colour, emission, transparency and the texture of the base colour.

use serde_json::Value;

use super::buffers::uri_bytes;
use super::{Reader, integer, item, numbers, refused, string};
use crate::error::Result;
use crate::mesh_file::{Material, Texture};
use crate::text::file_name;

impl Reader<'_, '_> {
    pub(super) fn material(&mut self, index: usize) -> Result<Material> {
        let source = item(self.root, "materials", index)?;
        let element = format!("material {index}");
        let glossy = source
            .get("extensions")
            .and_then(|extensions| extensions.get("KHR_materials_pbrSpecularGlossiness"));
        let (base, colour, texture) = match glossy {
            Some(glossy) => (glossy, "diffuseFactor", "diffuseTexture"),
            None => (
                &source["pbrMetallicRoughness"],
                "baseColorFactor",
                "baseColorTexture",
            ),
        };
        let [red, green, blue, alpha] = numbers(base, colour, &element)?
            .unwrap_or([1.0; 4])
            .map(|x: f64| x.clamp(0.0, 1.0));
        let emission = numbers(source, "emissiveFactor", &element)?
            .map(|colour: [f64; 3]| colour.map(|x| x.clamp(0.0, 1.0)));
        let specular: Option<[f64; 3]> = glossy.map_or(Ok(None), |glossy| {
            numbers(glossy, "specularFactor", &element)
        })?;
        Ok(Material {
            name: string(source, "name").unwrap_or("").into(),
            diffuse: Some([red, green, blue]),
            specular: specular.map(|colour| colour.map(|x| x.clamp(0.0, 1.0))),
            emission,
            transparency: if string(source, "alphaMode") == Some("BLEND") {
                1.0 - alpha
            } else {
                0.0
            },
            double_sided: source
                .get("doubleSided")
                .and_then(Value::as_bool)
                .unwrap_or(false),
            texture: base
                .get(texture)
                .map_or(Ok(None), |texture| self.texture(texture, &element))?,
        })
    }

    /// The texture that a texture reference names; one that cannot be had is a warning.
    fn texture(&mut self, reference: &Value, element: &str) -> Result<Option<usize>> {
        let Some(index) = integer(reference, "index", element)? else {
            return Ok(None);
        };
        let texture = item(self.root, "textures", index)?;
        let webp = texture
            .get("extensions")
            .and_then(|extensions| extensions.get("EXT_texture_webp"));
        let source = integer(texture, "source", element)?;
        let Some(image) = source.map_or_else(
            || webp.map_or(Ok(None), |webp| integer(webp, "source", element)),
            |source| Ok(Some(source)),
        )?
        else {
            return Ok(None);
        };
        item(self.root, "images", image)?;
        if let Some(known) = self.images[image] {
            return Ok(known);
        }
        let found = self.image(image)?;
        self.images[image] = Some(found);
        Ok(found)
    }

    fn image(&mut self, index: usize) -> Result<Option<usize>> {
        let image = item(self.root, "images", index)?;
        let uri = string(image, "uri");
        let (name, bytes) = match (uri, integer(image, "bufferView", "image")?) {
            (Some(uri), _) => (file_name(uri), uri_bytes(uri, self.resolve)),
            (None, Some(view)) => (
                string(image, "name").unwrap_or(""),
                Ok(self.buffers.view(self.root, view)?.0.to_vec()),
            ),
            (None, None) => {
                return Err(refused(
                    format!("image {index}"),
                    "neither a uri nor a bufferView",
                ));
            }
        };
        let is_inside = uri.is_none_or(|uri| uri.starts_with("data:"));
        let name = if is_inside {
            inside_name(string(image, "name"), string(image, "mimeType"), index)
        } else {
            name.into()
        };
        match bytes {
            Ok(bytes) => {
                self.file.textures.push(Texture { name, bytes });
                Ok(Some(self.file.textures.len() - 1))
            }
            Err(why) => {
                self.file.warnings.push(format!("texture {name}: {why}"));
                Ok(None)
            }
        }
    }
}

/// A picture in the file has no file name: one is made of its own and its kind.
fn inside_name(name: Option<&str>, kind: Option<&str>, index: usize) -> String {
    let extension = match kind {
        Some("image/jpeg") => "jpg",
        Some("image/webp") => "webp",
        _ => "png",
    };
    match name.map(file_name).filter(|name| !name.is_empty()) {
        Some(name) if name.contains('.') => name.into(),
        Some(name) => format!("{name}.{extension}"),
        None => format!("image{index}.{extension}"),
    }
}
