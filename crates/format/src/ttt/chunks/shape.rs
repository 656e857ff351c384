//! Shapes: geometry, materials, textures.

use super::Colour;
use crate::ttt::stream::streams;
use crate::ttt::tree::{Mesh, MeshTree};
use crate::ttt::value::{
    EngineBlock, Heights, Indices, Normals, PositionFirst, Rest, RotationFirst, Text,
};

streams! {
    /// A shape, except for what all objects have.
    Shape until b"EOO" {
        geometry: Option<ShapeGeometry> = b"Ge2",
        /// Geometry stream of serialization 15 and earlier (not readable by any open release); read only.
        geom_v15: Option<Rest<u8>> = b"Geo",
        /// Read only.
        sco_v15: Option<Colour> = b"Sco",
        /// Read only.
        sc2_v15: Option<Colour> = b"Sc2",
        /// Read only.
        eco_v15: Option<Colour> = b"Eco",
        /// Read only.
        edge_width_v15: Option<i32> = b"Ewt",
        /// Own physics material (since 3.3.3).
        material: Option<Material> = b"Mat",
        respondable_mask: Option<u16> = b"Dc2",
        /// Lvx, lvy, lvz, avx, avy, avz; initial linear, angular velocity.
        initial_velocity: Option<[f64; 6]> = b"_dv" / b"Idv",
        /// Bit1 clear=kinematic, bit6 start asleep, bit7 clear=static.
        switches: Option<u8> = b"Sss",
        /// Bit0 respondable; read only.
        switches_2: Option<u8> = b"Ss2",
        /// Bit0 respondable, bit5 set-to-dynamic-if-gets-parent.
        switches_3: Option<u8> = b"Ss3",
    }

    /// The geometry of a shape: one mesh, or a tree.
    ShapeGeometry until b"EOO" {
        /// Simple shape: one mesh.
        mesh: Option<Mesh> = b"Gst",
        /// Compound shape.
        group: Option<MeshNode> = b"Gsg",
        /// Precomputed OBB tree (geometric plugin, optional).
        calc_struct: Option<Rest<u8>> = b"Coj",
        /// As Coj, single precision, written 3.x-4.4; read only.
        old_calc_struct: Option<Rest<u8>> = b"Coi",
    }

    /// A node of a geometry: frame, mass, and the children of a group.
    MeshNode until b"EOO" {
        name: Option<Text> = b"Nme",
        mass: Option<f64> = b"_as" / b"Mas",
        /// Id of a DMA chunk.
        dyn_material_id: Option<i32> = b"Dmi",
        /// Ix, iy, iz, iqw, iqx, iqy, iqz, p1, p2, p3; old inertia frame + principal moments per mass.
        old_inertia: Option<(PositionFirst, [f64; 3])> = b"_ne" / b"Ine",
        /// Old cumulative frame since grouping.
        old_frame: Option<PositionFirst> = b"_tb" / b"Vtb",
        /// Frame of this node relative to parent node (since 4.5.1 rev2/4.6); its presence selects the new layout.
        frame: Option<PositionFirst> = b"Ifr",
        /// Cx, cy, cz; centre of mass in node frame.
        centre_of_mass: Option<[f64; 3]> = b"Com",
        /// Inertia tensor divided by mass, row major, about the centre of mass.
        inertia: Option<[f64; 9]> = b"Imx",
        /// Bounding box frame.
        box_frame: Option<PositionFirst> = b"Bbf",
        /// Bbx, bby, bbz; bounding box size.
        box_size: Option<[f64; 3]> = b"Bbs",
        /// Bit2 convex (old test result).
        switches: Option<u8> = b"Var",
        /// Child mesh.
        children: Vec<MeshTree> = b"Geo" | b"Wrp",
        /// Serialization 16: bullet restitution, friction, lin. damping, ang. damping, margin factor; read only.
        bul_v16: Option<[f32; 5]> = b"Bul",
        /// Serialization 16: as material Od2; read only.
        ode_v16: Option<(i32, [f32; 5])> = b"Ode",
    }

    /// Data of a mesh in addition to those of a node.
    MeshData until b"EOO" {
        /// Visual colour.
        colour: Option<Colour> = b"Cl0",
        /// Deprecated inside colour.
        inside_colour: Option<Colour> = b"Cl2",
        /// Deprecated edge colour.
        edge_colour: Option<Colour> = b"Ecl",
        /// Index among VIN Ver chunks.
        vertices_at: Option<i32> = b"Vev",
        /// Index among VIN Ind/In2 chunks.
        indices_at: Option<i32> = b"Inv",
        /// Index among VIN Nor/No2 chunks.
        normals_at: Option<i32> = b"Nov",
        /// Index among VIN Ved chunks.
        edges_at: Option<i32> = b"Vvd",
        /// Inline arrays, before serialization 18.
        vertices: Option<Rest<f32>> = b"Ver",
        /// Read only.
        indices: Option<Indices> = b"Ind" | b"In2",
        /// Read only.
        normals: Option<Normals> = b"Nor" | b"No2",
        /// Read only.
        edges: Option<Rest<u8>> = b"Ved",
        /// Primitive, px, py, pz; primitive type and sizes.
        primitive: Option<(i32, [f64; 3])> = b"_pr" / b"Ppr",
        /// Hollow scaling.
        inside_scaling: Option<f64> = b"_p2" / b"Pp2",
        /// Old vertices local frame.
        old_vertex_frame: Option<PositionFirst> = b"_pf" / b"Ppf",
        /// Shading angle, edge width; also sets edge threshold angle.
        shading: Option<(f64, i32)> = b"_sa" / b"Gsa",
        edge_threshold_angle: Option<f64> = b"_s2" / b"Gs2",
        /// Bit0 visible edges, bit1 backface culling, bit2 wireframe, bit3 reserved, bit5 convexity known, bit6 reserved, bit7 hide edge borders.
        switches: Option<u8> = b"Var",
        /// Bit0 convex.
        switches_2: Option<u8> = b"Va2",
        /// Texture mapping, optional.
        texture: Option<TextureMapping> = b"Toj",
        heightfield: Option<Heights> = b"_fd" / b"Hfd",
    }

    /// The arrays meshes share; they refer to the n-th chunk of each kind.
    MeshPool until b"EOO" {
        /// Flat xyz array.
        vertices: Vec<Rest<f32>> = b"Ver",
        /// Flat triangle index array.
        indices: Vec<Indices> = b"Ind" | b"In2",
        /// Flat xyz array, one normal per triangle corner.
        normals: Vec<Normals> = b"Nor" | b"No2",
        /// Bit array, one bit per triangle edge.
        edges: Vec<Rest<u8>> = b"Ved",
    }

    /// Texture mapping on a mesh.
    TextureMapping until b"EOO" {
        /// Bit0 interpolate, bit1 decal, bit2 repeat U, bit3 repeat V.
        old_flags: Option<u8> = b"Bst",
        /// Bit0 interpolate, bit2 repeat U, bit3 repeat V.
        flags: Option<u8> = b"Bs2",
        /// Texture id, coord mode, scale u, scale v; texture or vision sensor id.
        source: Option<([i32; 2], [f64; 2])> = b"_ob" / b"Tob",
        /// Projection pose.
        projection: Option<RotationFirst> = b"_rc" / b"Trc",
        /// Explicit uv, 2 per triangle corner; empty when projected.
        uv: Option<Rest<f32>> = b"Ftc",
        /// 0 modulate,1 decal,2 add.
        apply_mode: Option<i32> = b"Apm",
    }

    /// An image.
    Texture until b"EOO" {
        /// Id, width, height.
        id_and_size: Option<[i32; 3]> = b"Ipa",
        name: Option<Text> = b"Gon",
        /// Bit0 image has alpha.
        flags: Option<u8> = b"Bst",
        /// Width*height*(3 or 4) bytes.
        pixels: Option<Rest<u8>> = b"Img",
    }

    /// A material, as each physics engine sees it.
    Material until b"EOO" {
        id: Option<i32> = b"Ipa",
        name: Option<Text> = b"Gon",
        bcv: Option<u8> = b"Bcv",
        /// Restitution, friction(old), linear damping, angular damping, margin factor, margin factor convex (order: see text).
        bul: Option<[f32; 6]> = b"Bul",
        /// Read only.
        ode: Option<(i32, [f32; 5])> = b"Ode",
        /// MaxContacts, friction, soft ERP, soft CFM, lin damping, ang damping; read only.
        od2: Option<(i32, [f32; 5])> = b"Od2",
        vortex: Option<EngineBlock> = b"_o4" / b"Vo4",
        newton: Option<EngineBlock> = b"_w1" / b"Nw1",
        /// Bit0 non-default margin, bit1 sticky, bit2 auto shrink, bit3 non-default margin convex (Bullet).
        mvar: Option<u8> = b"Var",
        bullet: Option<EngineBlock> = b"_uN" / b"BuN",
        ode_values: Option<EngineBlock> = b"_dN" / b"OdN",
        mujoco: Option<EngineBlock> = b"_j1" / b"Mj1",
    }
}
