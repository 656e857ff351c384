//! `simUI.*`: plots.

use api_macro::api;
use scene::numbers;

use super::arguments::{Options, WindowHandle};
use crate::{ApiFn, Cx, Result, functions};
use ui::{Curve, CurveType, Plot};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    add_curve,
    add_curve_time_points,
    add_curve_xy_points,
    clear_curve,
    remove_curve,
    get_curve_data,
    replot,
    set_plot_ranges,
    set_plot_x_range,
    set_plot_y_range,
    grow_plot_ranges,
    grow_plot_x_range,
    grow_plot_y_range,
    rescale_axes,
    rescale_axes_all,
    set_plot_labels,
    set_plot_x_label,
    set_plot_y_label,
    set_mouse_options,
    set_legend_visibility,
];

const X: usize = 0;
const Y: usize = 1;

fn change(
    cx: &mut Cx,
    handle: &WindowHandle,
    id: i64,
    change: impl FnOnce(&mut Plot),
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        change(window.get_mut(id)?);
        Ok(())
    })
}

/// Adds a curve to a plot; nothing for an unknown type.
///
/// @param handle the window
/// @param id the plot
/// @param type simUI.curve_type: by time, or x and y by a parameter
/// @param name of the curve, in the legend
/// @param color red, green, blue, 0 to 255
/// @param style simUI.curve_style
/// @param options a map of scatter_shape, scatter_size, line_size, line_style, add_to_legend, selectable, track; may be empty
#[api("simUI.addCurve")]
#[allow(clippy::too_many_arguments, reason = "the reference's signature")]
fn add_curve(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    r#type: i64,
    name: String,
    color: [f64; 3],
    style: i64,
    options: Options,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        let plot = window.get_mut::<Plot>(id)?;
        let Some(curve_type) = CurveType::from_code(r#type) else {
            return Ok(());
        };
        let color = color.map(numbers::truncated);
        plot.add_curve(Curve {
            name,
            curve_type,
            color,
            style,
            options: options.0,
            points: Vec::new(),
        })
    })
}

/// Adds points to a curve by time. Of lists of different lengths the shorter one counts.
///
/// @param handle the window
/// @param id the plot
/// @param name of the curve
/// @param x times
/// @param y values
#[api("simUI.addCurveTimePoints")]
fn add_curve_time_points(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    name: String,
    x: Vec<f64>,
    y: Vec<f64>,
) -> Result<()> {
    let points = x.into_iter().zip(y).map(|(x, y)| [x, x, y]);
    cx.change_window(&handle.0, |window| {
        window
            .get_mut::<Plot>(id)?
            .add_points(&name, CurveType::Time, points)
    })
}

/// Adds points to a curve of x and y. Of lists of different lengths the shortest one counts.
///
/// @param handle the window
/// @param id the plot
/// @param name of the curve
/// @param t the parameter, which orders the points
/// @param x
/// @param y
#[api("simUI.addCurveXYPoints")]
fn add_curve_xy_points(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    name: String,
    t: Vec<f64>,
    x: Vec<f64>,
    y: Vec<f64>,
) -> Result<()> {
    let points = t.into_iter().zip(x).zip(y).map(|((t, x), y)| [t, x, y]);
    cx.change_window(&handle.0, |window| {
        window
            .get_mut::<Plot>(id)?
            .add_points(&name, CurveType::Xy, points)
    })
}

/// Removes the points of a curve.
///
/// @param handle the window
/// @param id the plot
/// @param name of the curve
#[api("simUI.clearCurve")]
fn clear_curve(cx: &mut Cx, handle: WindowHandle, id: i64, name: String) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.get_mut::<Plot>(id)?.clear_curve(&name)
    })
}

/// Removes a curve from a plot.
///
/// @param handle the window
/// @param id the plot
/// @param name of the curve
#[api("simUI.removeCurve")]
fn remove_curve(cx: &mut Cx, handle: WindowHandle, id: i64, name: String) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.get_mut::<Plot>(id)?.remove_curve(&name)
    })
}

/// The points of a curve.
///
/// @param handle the window
/// @param id the plot
/// @param name of the curve
/// @return t the parameter; empty for a curve by time
/// @return x
/// @return y
#[api("simUI.getCurveData")]
fn get_curve_data(
    cx: &Cx,
    handle: WindowHandle,
    id: i64,
    name: String,
) -> Result<(Vec<f64>, Vec<f64>, Vec<f64>)> {
    cx.read_window(&handle.0, |window| {
        let curve = window.get::<Plot>(id)?.curve(&name)?;
        let part = |part: usize| curve.points.iter().map(|point| point[part]).collect();
        let parameter = if curve.curve_type == CurveType::Time {
            Vec::new()
        } else {
            part(0)
        };
        Ok((parameter, part(1), part(2)))
    })
}

/// Draws a plot again. Pages show new points without it too.
///
/// @param handle the window
/// @param id the plot
#[api("simUI.replot")]
fn replot(cx: &mut Cx, handle: WindowHandle, id: i64) -> Result<()> {
    change(cx, &handle, id, |plot| plot.replots += 1)
}

/// Sets what both axes show.
///
/// @param handle the window
/// @param id the plot
/// @param xmin
/// @param xmax
/// @param ymin
/// @param ymax
#[api("simUI.setPlotRanges")]
#[allow(clippy::too_many_arguments, reason = "the reference's signature")]
fn set_plot_ranges(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    xmin: f64,
    xmax: f64,
    ymin: f64,
    ymax: f64,
) -> Result<()> {
    change(cx, &handle, id, |plot| {
        plot.ranges = [[xmin, xmax], [ymin, ymax]];
    })
}

/// Sets what the x axis shows.
///
/// @param handle the window
/// @param id the plot
/// @param xmin
/// @param xmax
#[api("simUI.setPlotXRange")]
fn set_plot_x_range(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    xmin: f64,
    xmax: f64,
) -> Result<()> {
    change(cx, &handle, id, |plot| plot.ranges[X] = [xmin, xmax])
}

/// Sets what the y axis shows.
///
/// @param handle the window
/// @param id the plot
/// @param ymin
/// @param ymax
#[api("simUI.setPlotYRange")]
fn set_plot_y_range(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    ymin: f64,
    ymax: f64,
) -> Result<()> {
    change(cx, &handle, id, |plot| plot.ranges[Y] = [ymin, ymax])
}

/// Lets both axes show more.
///
/// @param handle the window
/// @param id the plot
/// @param xmin how far the lower end moves down
/// @param xmax how far the upper end moves up
/// @param ymin how far the lower end moves down
/// @param ymax how far the upper end moves up
#[api("simUI.growPlotRanges")]
#[allow(clippy::too_many_arguments, reason = "the reference's signature")]
fn grow_plot_ranges(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    xmin: f64,
    xmax: f64,
    ymin: f64,
    ymax: f64,
) -> Result<()> {
    change(cx, &handle, id, |plot| {
        plot.grow(X, [xmin, xmax]);
        plot.grow(Y, [ymin, ymax]);
    })
}

/// Lets the x axis show more.
///
/// @param handle the window
/// @param id the plot
/// @param xmin how far the lower end moves down
/// @param xmax how far the upper end moves up
#[api("simUI.growPlotXRange")]
fn grow_plot_x_range(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    xmin: f64,
    xmax: f64,
) -> Result<()> {
    change(cx, &handle, id, |plot| plot.grow(X, [xmin, xmax]))
}

/// Lets the y axis show more.
///
/// @param handle the window
/// @param id the plot
/// @param ymin how far the lower end moves down
/// @param ymax how far the upper end moves up
#[api("simUI.growPlotYRange")]
fn grow_plot_y_range(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    ymin: f64,
    ymax: f64,
) -> Result<()> {
    change(cx, &handle, id, |plot| plot.grow(Y, [ymin, ymax]))
}

/// Fits the axes to a curve.
///
/// @param handle the window
/// @param id the plot
/// @param name of the curve
/// @param onlyEnlargeX whether the x axis may only show more
/// @param onlyEnlargeY whether the y axis may only show more
#[api("simUI.rescaleAxes")]
fn rescale_axes(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    name: String,
    #[default(false)] only_enlarge_x: bool,
    #[default(false)] only_enlarge_y: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window
            .get_mut::<Plot>(id)?
            .rescale(Some(&name), [only_enlarge_x, only_enlarge_y])
    })
}

/// Fits the axes to all curves.
///
/// @param handle the window
/// @param id the plot
/// @param onlyEnlargeX whether the x axis may only show more
/// @param onlyEnlargeY whether the y axis may only show more
#[api("simUI.rescaleAxesAll")]
fn rescale_axes_all(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    #[default(false)] only_enlarge_x: bool,
    #[default(false)] only_enlarge_y: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window
            .get_mut::<Plot>(id)?
            .rescale(None, [only_enlarge_x, only_enlarge_y])
    })
}

/// Sets the texts at both axes.
///
/// @param handle the window
/// @param id the plot
/// @param x
/// @param y
#[api("simUI.setPlotLabels")]
fn set_plot_labels(cx: &mut Cx, handle: WindowHandle, id: i64, x: String, y: String) -> Result<()> {
    change(cx, &handle, id, |plot| plot.labels = [x, y])
}

/// Sets the text at the x axis.
///
/// @param handle the window
/// @param id the plot
/// @param label
#[api("simUI.setPlotXLabel")]
fn set_plot_x_label(cx: &mut Cx, handle: WindowHandle, id: i64, label: String) -> Result<()> {
    change(cx, &handle, id, |plot| plot.labels[X] = label)
}

/// Sets the text at the y axis.
///
/// @param handle the window
/// @param id the plot
/// @param label
#[api("simUI.setPlotYLabel")]
fn set_plot_y_label(cx: &mut Cx, handle: WindowHandle, id: i64, label: String) -> Result<()> {
    change(cx, &handle, id, |plot| plot.labels[Y] = label)
}

/// What the mouse does in a plot.
///
/// @param handle the window
/// @param id the plot
/// @param panX whether it moves the x axis
/// @param panY whether it moves the y axis
/// @param zoomX whether it scales the x axis
/// @param zoomY whether it scales the y axis
#[api("simUI.setMouseOptions")]
#[allow(clippy::too_many_arguments, reason = "the reference's signature")]
fn set_mouse_options(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    pan_x: bool,
    pan_y: bool,
    zoom_x: bool,
    zoom_y: bool,
) -> Result<()> {
    change(cx, &handle, id, |plot| {
        plot.mouse = [pan_x, pan_y, zoom_x, zoom_y];
    })
}

/// Shows or hides the legend of a plot, which is hidden at first.
///
/// @param handle the window
/// @param id the plot
/// @param visible
#[api("simUI.setLegendVisibility")]
fn set_legend_visibility(cx: &mut Cx, handle: WindowHandle, id: i64, visible: bool) -> Result<()> {
    change(cx, &handle, id, |plot| plot.legend_visible = visible)
}
