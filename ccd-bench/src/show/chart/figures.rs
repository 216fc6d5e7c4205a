//! The paper's figures, redrawn: time and steps of every trial, one above the other `[FAST06 §6.2]`.

use super::axis::Axis;
use super::grid::{HEAD, foot, foot_height, head};
use super::legend::Legend;
use super::look::Look;
use super::panel::{BOTTOM_MARGIN, LEFT_MARGIN, Label, Labelled, Panel, TOP_MARGIN, remark};
use super::sheet::{DrawError, FRAME, MARGIN, Pen, Rect, Sheet, WIDTH};
use super::{ChartError, Charts, Drawing, Family, MethodFacts, SceneFacts, failed, is_papers};
use crate::run::measured::Trial;
use indicatif::HumanCount;

/// The heights of the upper and the lower panel.
const HEIGHTS: [f64; 2] = [200.0, 150.0];
/// The gap between columns, and between the two rows of panels.
const GUTTER: f64 = 16.0;
/// The spacing of lines across, in trials: for few trials, and for more.
const EVERY: [usize; 2] = [25, 100];
/// The largest number of trials that counts as few.
const FEW: usize = 150;

/// The remark on the order of trials.
const REMARK: &str = "Trials in the order of their scene. Neighbours are independent: the lines only \
                      lead the eye.";

/// Scenes of one body, one after the other.
struct Column<'a> {
    title: String,
    scenes: Vec<(&'a SceneFacts<'a>, usize)>,
}

/// A panel of a column: its rectangle, title and axes, and the value of a trial that it shows.
type Row<'a> = (Rect, &'a str, &'a Axis, Label, fn(&Trial) -> f64);

/// A trial of a method, with its index among all trials of its column.
struct Numbered<'a> {
    number: f64,
    trial: &'a Trial,
}

/// Draws a chart for every figure that has scenes.
pub(super) fn charts(charts: &Charts<'_>) -> Result<Vec<Drawing>, ChartError> {
    let mut figures: Vec<_> = charts.scenes.iter().filter_map(|s| s.figure).collect();
    figures.sort_unstable();
    figures.dedup();
    let drawings = figures.into_iter().map(|figure| draw(charts, figure));
    Ok(drawings
        .collect::<Result<Vec<_>, _>>()?
        .into_iter()
        .flatten()
        .collect())
}

fn draw(charts: &Charts<'_>, figure: u8) -> Result<Option<Drawing>, ChartError> {
    let mut shown = charts.shown(&[Family::Ours, Family::Rival, Family::Peer]);
    shown.retain(|(method, _)| charts.published.contains(&method.name));
    for (_, look) in &mut shown {
        // Dashes of a few pixels would be lost on lines that go up and down at every pixel.
        look.dash = None;
    }
    let columns = columns(charts, figure, &shown);
    let trials = || {
        columns
            .iter()
            .flat_map(|column| shown.iter().map(move |(method, _)| (column, method)))
            .flat_map(|(column, method)| numbered(charts, column, method))
    };
    let axes = (
        Axis::logarithmic("time, ms", trials().map(|t| milliseconds(t.trial))),
        Axis::logarithmic("steps in time", trials().map(|t| t.trial.steps as f64)),
    );
    let (Some(time), Some(steps)) = axes else {
        return Ok(None);
    };
    let name = format!("figure-{figure}");
    let title = format!("Figure {figure} of the paper, redrawn: lower is better");
    let legend = Legend::of(&shown);
    let remarks = [REMARK.to_owned()];
    let panels = HEIGHTS.iter().sum::<f64>() + TOP_MARGIN + GUTTER;
    let legend_top = HEAD + panels + BOTTOM_MARGIN;
    let remarks_top = legend_top + legend.height() + GUTTER;
    let size = (WIDTH, remarks_top + foot_height(&remarks));
    let subtitle = "Tolerance 10⁻³; a marker for each trial, hollow where the method was late or \
                    missed contacts somewhere";
    let svg = Sheet::draw(&title, size, |sheet| {
        head(sheet, &title, subtitle)?;
        for (index, column) in columns.iter().enumerate() {
            let upper = upper_rect(index, columns.len());
            draw_column(charts, sheet, (column, upper), [&time, &steps], &shown)?;
        }
        legend.draw(sheet, (MARGIN, legend_top))?;
        foot(sheet, &remarks, remarks_top)
    });
    Ok(Some(Drawing {
        svg: svg.map_err(failed(&name))?,
        title: format!("{title}. Time and steps of every trial."),
        name,
    }))
}

fn milliseconds(trial: &Trial) -> f64 {
    trial.micros / 1e3
}

fn columns<'a>(
    charts: &Charts<'a>,
    figure: u8,
    shown: &[(&MethodFacts<'_>, Look)],
) -> Vec<Column<'a>> {
    let mut columns: Vec<Column<'a>> = Vec::new();
    for scene in charts.scenes.iter().filter(|s| s.figure == Some(figure)) {
        let last = shown
            .iter()
            .flat_map(|(method, _)| trials_of(charts, scene.name, method.name))
            .map(|trial| trial.row)
            .max();
        let Some(count) = last.map(|row| row + 1) else {
            continue;
        };
        let title = format!(
            "{}, {} triangles",
            scene.shape,
            HumanCount(scene.triangles as u64)
        );
        match columns.iter_mut().find(|column| column.title == title) {
            Some(column) => column.scenes.push((scene, count)),
            None => columns.push(Column {
                title,
                scenes: vec![(scene, count)],
            }),
        }
    }
    columns
}

fn trials_of<'a>(
    charts: &Charts<'a>,
    scene: &str,
    method: &str,
) -> impl Iterator<Item = &'a Trial> {
    charts.trials.iter().filter(move |trial| {
        trial.scene == scene && trial.method == method && is_papers(trial.tolerance)
    })
}

fn numbered<'a>(
    charts: &Charts<'a>,
    column: &Column<'_>,
    method: &MethodFacts<'_>,
) -> Vec<Numbered<'a>> {
    let mut before = 0;
    let mut trials = Vec::new();
    for (scene, count) in &column.scenes {
        let of_scene = trials_of(charts, scene.name, method.name);
        trials.extend(of_scene.map(|trial| Numbered {
            number: (before + trial.row) as f64 + 0.5,
            trial,
        }));
        before += count;
    }
    trials
}

/// Returns the rectangle of the upper panel of a column.
fn upper_rect(index: usize, columns: usize) -> Rect {
    let inside = WIDTH - 2.0 * MARGIN - LEFT_MARGIN;
    let pitch = (inside + GUTTER) / columns.max(1) as f64;
    Rect {
        left: MARGIN + LEFT_MARGIN + pitch * index as f64,
        top: HEAD + TOP_MARGIN,
        width: pitch - GUTTER,
        height: HEIGHTS[0],
    }
}

fn draw_column(
    charts: &Charts<'_>,
    sheet: &Sheet<'_>,
    (column, upper): (&Column<'_>, Rect),
    [time, steps]: [&Axis; 2],
    shown: &[(&MethodFacts<'_>, Look)],
) -> Result<(), DrawError> {
    let count = column.scenes.iter().map(|(_, count)| count).sum();
    let every = EVERY[usize::from(count > FEW)];
    let trial = Axis::counting("trial", count, every);
    let lower = Rect {
        top: upper.bottom() + GUTTER,
        height: HEIGHTS[1],
        ..upper
    };
    // Only the first column has labels.
    let left = if upper.left > MARGIN + LEFT_MARGIN {
        Label::Left
    } else {
        Label::Written
    };
    let rows: [Row<'_>; 2] = [
        (upper, &column.title, time, Label::Left, milliseconds),
        (lower, "", steps, Label::Written, |t| t.steps as f64),
    ];
    for (rect, title, y, below, value) in rows {
        let panel = Panel {
            rect,
            title,
            x: &trial,
            y,
            labelled: Labelled { x: below, y: left },
        };
        panel.draw(sheet)?;
        for (method, look) in shown {
            let trials = numbered(charts, column, method);
            draw_trials(sheet, &panel, &trials, (look, value))?;
        }
    }
    name_scenes(sheet, column, &trial, (upper, lower))
}

/// Draws one line for each scene, so that no line connects two scenes.
fn draw_trials(
    sheet: &Sheet<'_>,
    panel: &Panel<'_>,
    trials: &[Numbered<'_>],
    (look, value): (&Look, fn(&Trial) -> f64),
) -> Result<(), DrawError> {
    let pen = Pen {
        opacity: 0.3,
        ..Pen::solid(look.colour, 0.8)
    };
    for of_scene in trials.chunk_by(|a, b| a.trial.scene == b.trial.scene) {
        let spots: Vec<_> = of_scene
            .iter()
            .filter_map(|t| panel.spot(t.number, value(t.trial)))
            .collect();
        if spots.len() > 1 {
            sheet.line(&spots, pen)?;
        }
        for spot in spots {
            sheet.speck(spot, look)?;
        }
    }
    Ok(())
}

/// Separates the trials of scenes by lines, and names the scenes if there is more than one.
fn name_scenes(
    sheet: &Sheet<'_>,
    column: &Column<'_>,
    trial: &Axis,
    (upper, lower): (Rect, Rect),
) -> Result<(), DrawError> {
    if column.scenes.len() < 2 {
        return Ok(());
    }
    let mut before = 0;
    for (scene, count) in &column.scenes {
        let Some(share) = trial.share(before as f64) else {
            continue;
        };
        let x = upper.left + share * upper.width;
        if before > 0 {
            let pen = Pen::solid(FRAME, 1.0);
            sheet.line(&[(x, upper.top), (x, lower.bottom())], pen)?;
        }
        let spot = (x + 4.0, 0.5 * (upper.bottom() + lower.top));
        sheet.text(motion_of(scene), spot, remark())?;
        before += count;
    }
    Ok(())
}

/// Returns the last word of a scene's name, which distinguishes it from others of its body.
fn motion_of<'a>(scene: &SceneFacts<'a>) -> &'a str {
    scene.name.rsplit(' ').next().unwrap_or(scene.name)
}
