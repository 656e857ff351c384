//! Reading of files that refer to others.

use mesh_files::{Limits, MeshFile, MeshFormat, ReadError, read};

pub fn parsed(bytes: &[u8], format: MeshFormat) -> Result<MeshFile, ReadError> {
    read(bytes, format, Limits::default(), &mut |name| {
        match name {
        "paint.mtl" => {
            Ok(b"newmtl red\nKd 1 0 0\nKs 0.5\nd 0.25\nmap_Kd -s 1 1 1 -o 0 0 a picture.png\nnewmtl plain\n".to_vec())
        }
        "a picture.png" | "pictures/a.png" => Ok(b"\x89PNG".to_vec()),
        "points.bin" => {
            Ok([0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].iter().flat_map(|x| x.to_le_bytes()).collect())
        }
        _ => Err("no such file".into()),
    }
    })
}

pub fn error(bytes: &[u8], format: MeshFormat) -> String {
    parsed(bytes, format)
        .expect_err("the file is refused")
        .to_string()
}
