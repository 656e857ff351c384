//! JUnit XML as Jenkins, GitHub's actions and GitLab read it: a suite per file, a case per test.

use std::borrow::Cow;
use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};

use super::parts;
use crate::{Outcome, Status, Summary};

type Xml = Writer<Vec<u8>>;

/// The report on a whole run.
pub fn report(summary: &Summary) -> Vec<u8> {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    write_report(&mut xml, summary).expect("memory takes every byte");
    let mut bytes = xml.into_inner();
    bytes.push(b'\n');
    bytes
}

fn write_report(xml: &mut Xml, summary: &Summary) -> io::Result<()> {
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let counts = counts(&summary.outcomes);
    let suites = xml
        .create_element("testsuites")
        .with_attribute(("name", "swanilda test"));
    let suites = suites.with_attributes(borrowed(&counts));
    suites
        .with_attribute(("time", seconds(summary.wall.as_secs_f64()).as_str()))
        .write_inner_content(|xml| {
            parts::files(summary).try_for_each(|outcomes| write_suite(xml, outcomes))
        })?;
    Ok(())
}

fn write_suite(xml: &mut Xml, outcomes: &[Outcome]) -> io::Result<()> {
    let file = outcomes[0].test.file.to_string_lossy();
    let file = clean(&file);
    let wall: f64 = outcomes
        .iter()
        .map(|outcome| outcome.wall.as_secs_f64())
        .sum();
    let suite = xml
        .create_element("testsuite")
        .with_attribute(("name", &*file));
    let suite = suite
        .with_attributes(borrowed(&counts(outcomes)))
        .with_attribute(("time", seconds(wall).as_str()));
    suite
        .with_attribute(("file", &*file))
        .write_inner_content(|xml| {
            outcomes
                .iter()
                .try_for_each(|outcome| write_case(xml, outcome))
        })?;
    Ok(())
}

fn write_case(xml: &mut Xml, outcome: &Outcome) -> io::Result<()> {
    let test = &outcome.test;
    let file = test.file.to_string_lossy();
    let mut case = xml.create_element("testcase").with_attributes([
        ("classname", &*clean(&class(&file))),
        ("name", &*clean(&test.title())),
        ("file", &*clean(&file)),
        ("time", &*seconds(outcome.wall.as_secs_f64())),
    ]);
    if let Some(line) = test.line {
        case = case.with_attribute(("line", line.to_string().as_str()));
    }
    case.write_inner_content(|xml| {
        write_properties(xml, outcome)?;
        write_result(xml, outcome)?;
        write_console(xml, outcome)
    })?;
    Ok(())
}

fn write_properties(xml: &mut Xml, outcome: &Outcome) -> io::Result<()> {
    let mut properties = vec![("seed", outcome.test.seed.to_string())];
    if outcome.steps > 0 {
        properties.push(("simulated_time", seconds(outcome.time)));
        properties.push(("steps", outcome.steps.to_string()));
    }
    properties.extend(outcome.capture.as_deref().map(|file| {
        let name = file.to_string_lossy();
        ("capture", clean(&name).into_owned())
    }));
    if let Some(property) = &outcome.property {
        properties.push(("cases", property.cases.to_string()));
        if property.robustness.is_finite() {
            properties.push(("robustness", property.robustness.to_string()));
        }
    }
    properties.extend(
        outcome
            .script
            .as_deref()
            .map(|script| ("script", clean(script).into_owned())),
    );
    xml.create_element("properties")
        .write_inner_content(|xml| {
            properties.iter().try_for_each(|(name, value)| {
                let property = xml
                    .create_element("property")
                    .with_attribute(("name", *name));
                property
                    .with_attribute(("value", value.as_str()))
                    .write_empty()
                    .map(drop)
            })
        })?;
    Ok(())
}

fn write_result(xml: &mut Xml, outcome: &Outcome) -> io::Result<()> {
    let message = clean(&outcome.message);
    let (element, kind) = match outcome.status {
        Status::Passed => return Ok(()),
        Status::Pending => {
            return xml
                .create_element("skipped")
                .with_attribute(("message", &*message))
                .write_empty()
                .map(drop);
        }
        Status::Failed => ("failure", "AssertionFailure"),
        Status::Error => ("error", "Error"),
    };
    let element = xml
        .create_element(element)
        .with_attributes([("message", &*message), ("type", kind)]);
    element
        .write_text_content(BytesText::new(&clean(&parts::details(outcome))))
        .map(drop)
}

fn write_console(xml: &mut Xml, outcome: &Outcome) -> io::Result<()> {
    if outcome.console.is_empty() {
        return Ok(());
    }
    let lines: String = outcome
        .console
        .iter()
        .map(|line| parts::console_line(line) + "\n")
        .collect();
    xml.create_element("system-out")
        .write_text_content(BytesText::new(&clean(&lines)))
        .map(drop)
}

/// The path as a name of classes: readers group by what is before the last dot.
fn class(file: &str) -> String {
    let stem = file.strip_suffix(".lua").unwrap_or(file);
    let names = stem
        .split(['/', '\\'])
        .filter(|name| !matches!(*name, "" | "." | ".."));
    names
        .map(|name| name.replace('.', "_"))
        .collect::<Vec<_>>()
        .join(".")
}

fn counts(outcomes: &[Outcome]) -> [(&'static str, String); 4] {
    let count = |status| parts::count(outcomes, status).to_string();
    [
        ("tests", outcomes.len().to_string()),
        ("failures", count(Status::Failed)),
        ("errors", count(Status::Error)),
        ("skipped", count(Status::Pending)),
    ]
}

fn borrowed<'a>(
    attributes: &'a [(&'static str, String)],
) -> impl Iterator<Item = (&'a str, &'a str)> {
    attributes
        .iter()
        .map(|(name, value)| (*name, value.as_str()))
}

/// Plain decimals: readers know no exponents.
fn seconds(seconds: f64) -> String {
    format!("{seconds:.6}")
}

fn clean(text: &str) -> Cow<'_, str> {
    if text.chars().all(|c| parts::allowed(c) == c) {
        return Cow::Borrowed(text);
    }
    text.chars().map(parts::allowed).collect::<String>().into()
}

#[cfg(test)]
mod tests {
    use quick_xml::Reader;
    use quick_xml::events::{BytesStart, Event};

    use super::super::parts::sample;
    use super::*;

    /// Elements with their depth and attributes, and all text.
    fn parsed(bytes: &[u8]) -> (Vec<(usize, BytesStart<'static>)>, String) {
        let text = std::str::from_utf8(bytes).unwrap();
        let mut reader = Reader::from_str(text);
        let (mut elements, mut depth, mut texts) = (Vec::new(), 0, String::new());
        loop {
            match reader.read_event().unwrap() {
                Event::Start(start) => {
                    elements.push((depth, start.into_owned()));
                    depth += 1;
                }
                Event::Empty(start) => elements.push((depth, start.into_owned())),
                Event::End(_) => depth -= 1,
                Event::Text(text) => texts += &text,
                Event::GeneralRef(entity) => texts += &format!("&{};", &*entity),
                Event::Eof => break,
                _ => {}
            }
        }
        assert_eq!(depth, 0);
        (
            elements,
            quick_xml::escape::unescape(&texts).unwrap().into_owned(),
        )
    }

    fn attribute(element: &BytesStart<'_>, name: &str) -> String {
        let attribute = element
            .try_get_attribute(name)
            .unwrap()
            .unwrap_or_else(|| panic!("{name} is missing"));
        attribute
            .normalized_value(quick_xml::XmlVersion::Implicit1_0)
            .unwrap()
            .into_owned()
    }

    #[test]
    fn suites_cases_and_results() {
        let (elements, _) = parsed(&report(&sample::summary()));
        let named = |name: &str| {
            elements
                .iter()
                .filter(|(_, e)| e.name().as_ref() == name)
                .collect::<Vec<_>>()
        };
        let counts = |e: &BytesStart<'_>| {
            ["tests", "failures", "errors", "skipped"].map(|name| attribute(e, name))
        };
        assert_eq!(counts(&named("testsuites")[0].1), ["5", "1", "1", "2"]);
        let suites = named("testsuite");
        assert_eq!(counts(&suites[0].1), ["4", "1", "1", "1"]);
        assert_eq!(attribute(&suites[1].1, "name"), "b_test.lua");
        let cases = named("testcase");
        assert!(cases.iter().all(|(depth, _)| *depth == 2));
        assert_eq!(attribute(&cases[0].1, "classname"), "a.x_test");
        assert_eq!(attribute(&cases[0].1, "time"), "1.500000");
        assert_eq!(
            (
                named("failure").len(),
                named("error").len(),
                named("skipped").len()
            ),
            (1, 1, 2)
        );
        let seed = &named("property")[0].1;
        assert_eq!(
            (attribute(seed, "name"), attribute(seed, "value")),
            ("seed".into(), "7".into())
        );
    }

    #[test]
    fn whatever_was_said_comes_back_except_what_xml_forbids() {
        let (elements, texts) = parsed(&report(&sample::summary()));
        let said: String = sample::HOSTILE.chars().map(parts::allowed).collect();
        let failure = elements
            .iter()
            .find(|(_, e)| e.name().as_ref() == "failure")
            .unwrap();
        assert_eq!(
            attribute(&failure.1, "message"),
            format!("first line\n{said}")
        );
        assert!(texts.contains(&format!(">    2 | {said}\n")), "{texts}");
        assert!(
            texts.contains(&format!("0.050 {said}\n"))
                && texts.contains("[/Robot/script:warning] two\nlines")
        );
        assert!(
            texts.contains("in script /Robot/script")
                && texts.contains("at simulated time 0.500 s, after 10 steps")
        );
    }

    #[test]
    fn paths_become_names_of_classes() {
        assert_eq!(class("./a.b/../x_test.lua"), "a_b.x_test");
        assert_eq!(class("/x"), "x");
    }

    #[test]
    fn a_run_without_tests() {
        let (elements, _) = parsed(&report(&Summary::default()));
        assert_eq!(elements.len(), 1);
    }
}
