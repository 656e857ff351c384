//! Appearance of surfaces.

use crate::texture::Texture;

/// The appearance of a mesh, in the terms of OpenGL's fixed functions. Colours are red, green, blue, 0 to 1.
#[derive(Debug, Clone)]
pub struct Material {
    /// Colour under ambient and diffuse light.
    pub ambient_diffuse: [f32; 3],
    /// Colour of highlights.
    pub specular: [f32; 3],
    /// How sharp highlights are: the exponent of the specular term.
    pub shininess: u32,
    /// Colour of the light that the surface emits.
    pub emission: [f32; 3],
    /// 1 is opaque; below, what is behind shows through.
    pub opacity: f32,
    /// Whether back faces are left out. Otherwise they are lit like front faces, from their side.
    pub culling: bool,
    /// Only the edges of triangles are drawn, in the colour of the surface.
    pub wireframe: bool,
    /// Sharp edges drawn over the surface.
    pub edges: Option<Edges>,
    /// An image on the surface, if there is one.
    pub texture: Option<Texture>,
}

/// Edges that are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edges {
    /// Edges whose faces differ in direction by this or more are drawn (rad), and those of more than two faces.
    pub angle: f64,
    /// Whether the borders of open meshes are drawn too.
    pub borders: bool,
    /// Red, green, blue, 0 to 1.
    pub colour: [f32; 3],
    /// Pixels.
    pub width: f32,
}

impl Material {
    /// Opaque, with a faint highlight.
    pub fn new(ambient_diffuse: [f32; 3]) -> Self {
        Self {
            ambient_diffuse,
            specular: [0.25; 3],
            shininess: 48,
            emission: [0.0; 3],
            opacity: 1.0,
            culling: false,
            wireframe: false,
            edges: None,
            texture: None,
        }
    }

    /// The same colour from everywhere, whatever the light.
    pub fn unlit(colour: [f32; 3]) -> Self {
        Self {
            emission: colour,
            specular: [0.0; 3],
            ..Self::new([0.0; 3])
        }
    }
}
