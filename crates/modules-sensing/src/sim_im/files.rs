//! `simIM.*`: images in files and as texts.

use std::path::Path;

use api_macro::api;
use imaging::matrix::{Depth, Matrix, MatrixError};

use super::images::{refused, turned};
use super::objects::images;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use format::picture::{Layout, Picture};
use format::scene_file::write_whole;
use script::Text;
use wire::mime::{encode_base64, finish_base64};

pub(super) const FUNCTIONS: &[ApiFn] = functions![read, write, encode, data_url];

/// Of JPEG, 1 to 100.
const QUALITY: u8 = 95;

/// Reads an image file: PNG, JPEG, BMP or TGA.
///
/// @param filename the file
/// @return handle an image of bytes with three channels
#[api("simIM.read")]
fn read(cx: &Cx, filename: String) -> Result<String> {
    let path = Path::new(&filename);
    cx.permissions().check_read(path)?;
    let read = cx.permissions().read_checked(path);
    let file = read.map_err(|_| refused("invalid image"))?;
    let picture = Picture::decode(&file, Layout::Rgb).map_err(|_| refused("invalid image"))?;
    let size = picture.resolution().map(|side| side as usize);
    let image = Matrix::from_bytes(size, 3, turned(&picture.into_bytes(), 3))?;
    images(cx).add(cx, image)
}

/// Writes an image file. Floats become bytes.
///
/// @param handle the image
/// @param filename ends in .png, .jpg, .bmp or .tga
#[api("simIM.write")]
fn write(cx: &Cx, handle: String, filename: String) -> Result<()> {
    let image = images(cx).get(&handle)?;
    let path = Path::new(&filename);
    let extension = path
        .extension()
        .unwrap_or_default()
        .to_string_lossy()
        .to_lowercase();
    let file = file_of(&image, &extension)?;
    cx.permissions().check_write(path)?;
    let written = cx.permissions().write(path, || write_whole(path, &file));
    written.map_err(|error| refused(&format!("cannot write {filename}: {error}")))
}

/// The content of an image file.
///
/// @param handle the image
/// @param format BMP, JPG or PNG
/// @return output
#[api("simIM.encode")]
fn encode(cx: &Cx, handle: String, format: String) -> Result<Text> {
    let image = images(cx).get(&handle)?;
    let (extension, _) = kind_of(&format)?;
    Ok(Text(file_of(&image, extension)?))
}

/// An image as a URL with its content.
///
/// @param imgHandle the image
/// @param format BMP, JPG or PNG
/// @return output
#[api("simIM.dataURL")]
fn data_url(
    cx: &Cx,
    img_handle: String,
    #[default("BMP".to_owned())] format: String,
) -> Result<String> {
    let image = images(cx).get(&img_handle)?;
    let (extension, name) = kind_of(&format)?;
    let file = file_of(&image, extension)?;
    let (text, rest) = encode_base64(&file);
    Ok(format!(
        "data:image/{name};base64,{text}{}",
        finish_base64(rest)
    ))
}

/// Extension and MIME name of a format.
fn kind_of(format: &str) -> Result<(&'static str, &'static str)> {
    match format {
        "BMP" => Ok(("bmp", "bmp")),
        "JPG" => Ok(("jpg", "jpeg")),
        "PNG" => Ok(("png", "png")),
        _ => Err(refused(&format!("invalid format: {format}"))),
    }
}

fn file_of(image: &Matrix, extension: &str) -> Result<Vec<u8>> {
    let image = image.converted(Depth::Byte, 1.0);
    let bytes = image.bytes().unwrap_or_default();
    let (bytes, layout) = match image.format().channels {
        1 => (bytes.to_vec(), Layout::Grey),
        3 => (turned(bytes, 3), Layout::Rgb),
        4 => (
            bytes
                .as_chunks()
                .0
                .iter()
                .flat_map(|[b, g, r, a]| [*r, *g, *b, *a])
                .collect(),
            Layout::Rgba,
        ),
        _ => return Err(MatrixError::Format("a file").into()),
    };
    let picture = Picture::new(bytes, image.size().map(|side| side as i64), layout);
    picture
        .and_then(|picture| picture.encode(extension, QUALITY))
        .map_err(|error| opencv(&error.to_string()))
}

fn opencv(why: &str) -> ApiError {
    refused(&format!("OpenCV(imgcodecs): {why}"))
}
