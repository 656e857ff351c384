//! `simUI.*`: pictures of pixels, and drawings in SVG.

use std::path::Path;

use api_macro::api;
use scene::numbers;

use super::arguments::WindowHandle;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use format::picture::{Layout, Picture};
use script::Bytes;
use script::log::verbosity;
use ui::{Image, Svg, UiError};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    set_image_data,
    svg_load_file,
    svg_load_data,
    supported_image_formats
];

/// The kinds of files that image widgets read.
const FORMATS: [&str; 5] = ["bmp", "jpeg", "jpg", "png", "tga"];

/// Sets the picture of an image widget.
///
/// @param handle the window
/// @param id the image widget
/// @param data red, green, blue of each pixel, the bottom row first, as images of vision sensors
/// @param width pixels
/// @param height pixels
#[api("simUI.setImageData")]
fn set_image_data(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    data: Bytes,
    width: i64,
    height: i64,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        let image = window
            .get_mut::<Image>(id)
            .map_err(|_| UiError::NoImage(id))?;
        image.set_rgb(&data.0, width, height)
    })
}

/// Shows the drawing of a file.
///
/// @param handle the window
/// @param id the svg widget
/// @param file
#[api("simUI.svgLoadFile")]
fn svg_load_file(cx: &mut Cx, handle: WindowHandle, id: i64, file: String) -> Result<()> {
    cx.read_window(&handle.0, |window| window.get::<Svg>(id).map(|_| ()))?;
    let text = file_of(cx, &file).map_err(ApiError::Other)?;
    set_svg(
        cx,
        &handle.0,
        id,
        String::from_utf8_lossy(&text).into_owned(),
    )
}

/// Shows a drawing.
///
/// @param handle the window
/// @param id the svg widget
/// @param data the text of the drawing
#[api("simUI.svgLoadData")]
fn svg_load_data(cx: &mut Cx, handle: WindowHandle, id: i64, data: String) -> Result<()> {
    set_svg(cx, &handle.0, id, data)
}

fn set_svg(cx: &mut Cx, handle: &str, id: i64, text: String) -> Result<()> {
    cx.change_window(handle, |window| {
        window.get_mut::<Svg>(id)?.text = text;
        Ok(())
    })
}

/// The kinds of files that image widgets read.
///
/// @param separator what to put between them in a text, if one is wanted
/// @return formatList
/// @return formatListStr nothing without separator
#[api("simUI.supportedImageFormats")]
fn supported_image_formats(
    _cx: &Cx,
    separator: Option<String>,
) -> Result<(Vec<String>, Option<String>)> {
    Ok((
        FORMATS.map(str::to_owned).to_vec(),
        separator.map(|separator| FORMATS.join(&separator)),
    ))
}

/// Loads the files that the text of a window names. What cannot be loaded is logged.
pub(super) fn load_files(cx: &mut Cx, handle: &str) -> Result<()> {
    let (images, drawings) = cx.read_window(handle, |window| {
        let images = window
            .all::<Image>()
            .filter(|(_, image)| !image.file.is_empty());
        let images: Vec<_> = images
            .map(|(id, image)| (id, image.file.clone(), [image.width, image.height]))
            .collect();
        let drawings = window.all::<Svg>().filter(|(_, svg)| !svg.file.is_empty());
        Ok((
            images,
            drawings
                .map(|(id, svg)| (id, svg.file.clone()))
                .collect::<Vec<_>>(),
        ))
    })?;
    for (id, file, size) in images {
        match picture_of(cx, &file, size.map(numbers::count)) {
            Ok(picture) => set_picture(cx, handle, id, picture)?,
            Err(reason) => log_failure(cx, &file, &reason),
        }
    }
    for (id, file) in drawings {
        match file_of(cx, &file) {
            Ok(text) => set_svg(cx, handle, id, String::from_utf8_lossy(&text).into_owned())?,
            Err(reason) => log_failure(cx, &file, &reason),
        }
    }
    Ok(())
}

fn log_failure(cx: &Cx, file: &str, reason: &str) {
    cx.env().log(
        verbosity::SCRIPT_ERRORS,
        &format!("Failed to load image {file}: {reason}"),
    );
}

fn file_of(cx: &Cx, file: &str) -> std::result::Result<Vec<u8>, String> {
    let path = Path::new(file);
    cx.permissions()
        .check_read(path)
        .map_err(|denied| denied.to_string())?;
    cx.permissions()
        .read_checked(path)
        .map_err(|error| error.to_string())
}

/// The picture of a file, scaled to a size that is positive.
fn picture_of(cx: &Cx, file: &str, size: [i64; 2]) -> std::result::Result<Picture, String> {
    let picture =
        Picture::decode(&file_of(cx, file)?, Layout::Rgba).map_err(|error| error.to_string())?;
    if size.iter().all(|side| *side > 0) {
        return picture
            .scaled(size, false, Layout::Rgba)
            .map_err(|error| error.to_string());
    }
    Ok(picture)
}

fn set_picture(cx: &mut Cx, handle: &str, id: i64, picture: Picture) -> Result<()> {
    cx.change_window(handle, |window| {
        let image = window.get_mut::<Image>(id)?;
        [image.width, image.height] = picture.resolution().map(|side| side as usize);
        image.pixels = picture.into_bytes();
        Ok(())
    })
}
