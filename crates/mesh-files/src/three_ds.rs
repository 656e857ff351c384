//! 3D Studio: chunks of meshes and materials. Vertices are in the file's frame already; key frames, lights and cameras are left out.

use std::collections::BTreeMap;

use crate::Resolve;
use crate::bytes::Bytes;
use crate::corners::{Corner, Lists, NONE, part};
use crate::error::{Location, ReadError, Result};
use crate::limits::Limits;
use crate::mesh_file::{Material, MeshFile, Texture};
use crate::text::file_name;

const MAIN: u16 = 0x4d4d;
const EDITOR: u16 = 0x3d3d;
const OBJECT: u16 = 0x4000;
const MESH: u16 = 0x4100;
const VERTICES: u16 = 0x4110;
const FACES: u16 = 0x4120;
const FACE_MATERIAL: u16 = 0x4130;
const TEXTURE_COORDINATES: u16 = 0x4140;
const MATERIAL: u16 = 0xafff;
const MATERIAL_NAME: u16 = 0xa000;
const DIFFUSE: u16 = 0xa020;
const SPECULAR: u16 = 0xa030;
const TRANSPARENCY: u16 = 0xa050;
const TEXTURE: u16 = 0xa200;
const TEXTURE_NAME: u16 = 0xa300;

#[derive(Default)]
struct Mesh {
    name: String,
    positions: Vec<[f64; 3]>,
    uv: Vec<[f64; 2]>,
    faces: Vec<[u16; 3]>,
    /// Names of materials with the numbers of their faces.
    materials: Vec<(String, Vec<u16>)>,
}

#[derive(Default)]
struct Reader {
    meshes: Vec<Mesh>,
    materials: BTreeMap<String, (Material, Option<String>)>,
}

pub(crate) fn read(bytes: &[u8], mut limits: Limits, resolve: Resolve) -> Result<MeshFile> {
    let mut reader = Reader::default();
    let mut file = Bytes::new(bytes, 0);
    match chunk(&mut file)? {
        (MAIN, content) => reader.main(content)?,
        (kind, _) => {
            return Err(ReadError::new(
                Location::Byte(0),
                "chunk",
                format!("{kind:#06x} does not begin a 3DS file"),
            ));
        }
    }
    let mut file = MeshFile::default();
    let mut known = BTreeMap::new();
    for (name, (material, path)) in reader.materials {
        let texture = path.and_then(|path| texture(&path, &mut file, resolve));
        known.insert(
            name,
            Material {
                texture,
                ..material
            },
        );
    }
    for mesh in &reader.meshes {
        mesh.parts(&known, &mut limits, &mut file)?;
    }
    Ok(file)
}

fn texture(path: &str, file: &mut MeshFile, resolve: Resolve) -> Option<usize> {
    let name = file_name(path);
    if let Some(known) = file
        .textures
        .iter()
        .position(|texture| texture.name == name)
    {
        return Some(known);
    }
    match resolve(path) {
        Ok(bytes) => {
            file.textures.push(Texture {
                name: name.into(),
                bytes,
            });
            Some(file.textures.len() - 1)
        }
        Err(why) => {
            file.warnings.push(format!("texture {path}: {why}"));
            None
        }
    }
}

/// The kind and the content of the next chunk; its length counts its own head.
fn chunk<'a>(bytes: &mut Bytes<'a>) -> Result<(u16, Bytes<'a>)> {
    let place = bytes.place();
    let kind = bytes.u16("chunk")?;
    let length = numbers::place(bytes.u32("chunk")?);
    let Some(length) = length.checked_sub(6) else {
        return Err(ReadError::new(
            place,
            format!("chunk {kind:#06x}"),
            "shorter than its head",
        ));
    };
    let at = bytes.at();
    Ok((kind, Bytes::new(bytes.take(length, "chunk")?, at)))
}

fn chunks(mut bytes: Bytes, mut each: impl FnMut(u16, Bytes) -> Result<()>) -> Result<()> {
    while bytes.len() > 0 {
        let (kind, content) = chunk(&mut bytes)?;
        each(kind, content)?;
    }
    Ok(())
}

impl Reader {
    fn main(&mut self, main: Bytes) -> Result<()> {
        chunks(main, |kind, editor| match kind {
            EDITOR => chunks(editor, |kind, content| match kind {
                OBJECT => self.object(content),
                MATERIAL => self.material(content),
                _ => Ok(()),
            }),
            _ => Ok(()),
        })
    }

    fn object(&mut self, mut content: Bytes) -> Result<()> {
        let name = content.text("object")?;
        chunks(content, |kind, content| {
            if kind == MESH {
                let mut mesh = Mesh {
                    name: name.clone(),
                    ..Mesh::default()
                };
                chunks(content, |kind, content| mesh.chunk(kind, content))?;
                self.meshes.push(mesh);
            }
            Ok(())
        })
    }

    fn material(&mut self, content: Bytes) -> Result<()> {
        let (mut name, mut material, mut path) = (String::new(), Material::default(), None);
        chunks(content, |kind, mut content| {
            match kind {
                MATERIAL_NAME => name = content.text("material")?,
                DIFFUSE => material.diffuse = colour(content)?,
                SPECULAR => material.specular = colour(content)?,
                TRANSPARENCY => material.transparency = share(content)?,
                TEXTURE => chunks(content, |kind, mut content| {
                    if kind == TEXTURE_NAME {
                        path = Some(content.text("texture")?);
                    }
                    Ok(())
                })?,
                _ => {}
            }
            Ok(())
        })?;
        material.name.clone_from(&name);
        self.materials.insert(name, (material, path));
        Ok(())
    }
}

/// A colour of three floats (0x0010, 0x0013) or bytes (0x0011, 0x0012).
fn colour(content: Bytes) -> Result<Option<[f64; 3]>> {
    let mut colour = None;
    chunks(content, |kind, mut content| {
        match kind {
            0x0010 | 0x0013 => colour = Some(content.vector("colour")?.map(|x| x.clamp(0.0, 1.0))),
            0x0011 | 0x0012 => {
                colour = Some(content.array::<3>("colour")?.map(|x| f64::from(x) / 255.0));
            }
            _ => {}
        }
        Ok(())
    })?;
    Ok(colour)
}

/// A percentage: an integer (0x0030) or a float (0x0031).
fn share(content: Bytes) -> Result<f64> {
    let mut share = 0.0;
    chunks(content, |kind, mut content| {
        match kind {
            0x0030 => share = f64::from(content.u16("percentage")?) / 100.0,
            0x0031 => share = f64::from(content.f32("percentage")?) / 100.0,
            _ => {}
        }
        Ok(())
    })?;
    Ok(if share.is_finite() {
        share.clamp(0.0, 1.0)
    } else {
        0.0
    })
}

impl Mesh {
    fn chunk(&mut self, kind: u16, mut content: Bytes) -> Result<()> {
        match kind {
            VERTICES => {
                let count = content.u16("vertices")?;
                content.check_room(count.into(), 12, "vertices")?;
                self.positions = (0..count)
                    .map(|_| content.vector("vertex"))
                    .collect::<Result<_>>()?;
            }
            TEXTURE_COORDINATES => {
                let count = content.u16("texture coordinates")?;
                content.check_room(count.into(), 8, "texture coordinates")?;
                let mut next = || {
                    content
                        .f32("texture coordinates")
                        .map(|x| if x.is_finite() { f64::from(x) } else { 0.0 })
                };
                self.uv = (0..count)
                    .map(|_| Ok([next()?, next()?]))
                    .collect::<Result<_>>()?;
            }
            FACES => self.faces(content)?,
            _ => {}
        }
        Ok(())
    }

    fn faces(&mut self, mut content: Bytes) -> Result<()> {
        let count = content.u16("faces")?;
        content.check_room(count.into(), 8, "faces")?;
        for _ in 0..count {
            self.faces.push([
                content.u16("face")?,
                content.u16("face")?,
                content.u16("face")?,
            ]);
            content.u16("flags of a face")?;
        }
        chunks(content, |kind, mut content| {
            if kind == FACE_MATERIAL {
                let name = content.text("material of faces")?;
                let count = content.u16("material of faces")?;
                content.check_room(count.into(), 2, "material of faces")?;
                let faces = (0..count)
                    .map(|_| content.u16("material of faces"))
                    .collect::<Result<_>>()?;
                self.materials.push((name, faces));
            }
            Ok(())
        })
    }

    /// A part for each material, and one for the faces without any.
    fn parts(
        &self,
        known: &BTreeMap<String, Material>,
        limits: &mut Limits,
        file: &mut MeshFile,
    ) -> Result<()> {
        let mut is_left = vec![true; self.faces.len()];
        for (name, faces) in &self.materials {
            let mut own = Vec::new();
            for &face in faces {
                if let Some(is_left) = is_left
                    .get_mut(usize::from(face))
                    .filter(|is_left| **is_left)
                {
                    *is_left = false;
                    own.push(self.corners(self.faces[usize::from(face)])?);
                }
            }
            let material = known.get(name).cloned().unwrap_or_else(|| Material {
                name: name.clone(),
                ..Material::default()
            });
            self.part(&own, material, limits, file)?;
        }
        let rest = self
            .faces
            .iter()
            .zip(&is_left)
            .filter(|(_, is_left)| **is_left);
        let rest = rest
            .map(|(face, _)| self.corners(*face))
            .collect::<Result<Vec<_>>>()?;
        self.part(&rest, Material::default(), limits, file)
    }

    fn part(
        &self,
        corners: &[[Corner; 3]],
        material: Material,
        limits: &mut Limits,
        file: &mut MeshFile,
    ) -> Result<()> {
        if corners.is_empty() {
            return Ok(());
        }
        let lists = Lists {
            positions: &self.positions,
            normals: &[],
            uv: &self.uv,
        };
        let part = part(self.name.clone(), lists, corners, material);
        limits.take(part.vertices.len(), part.triangles.len())?;
        file.parts.push(part);
        Ok(())
    }

    fn corners(&self, face: [u16; 3]) -> Result<[Corner; 3]> {
        if let Some(index) = face
            .iter()
            .find(|index| usize::from(**index) >= self.positions.len())
        {
            let problem = format!("vertex {index} of {}", self.positions.len());
            return Err(ReadError::new(
                Location::File,
                format!("face of {:?}", self.name),
                problem,
            ));
        }
        let uv = |index: u16| {
            if usize::from(index) < self.uv.len() {
                index.into()
            } else {
                NONE
            }
        };
        Ok(face.map(|index| Corner {
            position: index.into(),
            normal: NONE,
            uv: uv(index),
        }))
    }
}
