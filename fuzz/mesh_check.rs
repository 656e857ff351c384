//! What must hold for any mesh file that is read.

use mesh_files::{ExportFormat, MeshFormat, Limits, read, write};

pub fn check(bytes: &[u8], format: MeshFormat) {
    let limits = Limits { vertices: 100_000, triangles: 100_000, parts: 1000 };
    let Ok(mut file) = read(bytes, format, limits, &mut |_| Ok(bytes.to_vec())) else { return };
    let triangles: usize = file.parts.iter().map(|part| part.triangles.len()).sum();
    for part in &file.parts {
        assert!(part.normals.is_empty() || part.normals.len() == part.triangles.len());
        assert!(part.uv.is_empty() || part.uv.len() == part.triangles.len());
        assert!(part.material.texture.is_none_or(|texture| texture < file.textures.len()));
    }
    file.merge_identical();
    file.merge_parts();
    let text = write(&file, ExportFormat::PlyText, "mesh.ply").expect("what was read is sound");
    let again = read(&text[0].bytes, MeshFormat::Ply, limits, &mut |_| Err(String::new())).expect("what was written is read");
    assert_eq!(again.parts[0].triangles.len(), triangles);
    for format in [ExportFormat::Obj, ExportFormat::Collada, ExportFormat::Glb] {
        write(&file, format, "mesh").expect("what was read is sound");
    }
}
