use super::*;
use serde_json::Value;
use std::collections::{BTreeSet, HashSet};

type Table = serde_json::Map<String, Value>;

fn table(language: Language) -> Table {
    as_table(language.words())
}

fn as_table(words: &impl serde::Serialize) -> Table {
    serde_json::to_value(words).unwrap().as_object().unwrap().clone()
}

/// The tables of single pages, with the templates that have them as `t`.
fn tables_of_pages(language: Language) -> [(&'static str, Table, &'static [&'static str]); 3] {
    [
        ("charts", as_table(language.chart_words()), &[]),
        ("speed", as_table(language.speed_words()), &["speed.html"]),
        ("stability", as_table(language.stability_words()), &["stability.html", "form.html"]),
    ]
}

fn places(text: &str) -> BTreeSet<&str> {
    text.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0)).collect()
}

/// The compiler sees to it that both have all keys; what they say has the same places.
#[test]
fn the_languages_fill_the_same_places() {
    let (english, japanese) = (table(Language::English), table(Language::Japanese));
    assert!(english.len() > 100);
    compare(&english, &japanese);
    for (english, japanese) in tables_of_pages(Language::English).iter().zip(&tables_of_pages(Language::Japanese)) {
        compare(&english.1, &japanese.1);
    }
}

fn compare(english: &Table, japanese: &Table) {
    for (key, text) in english {
        let (text, other) = (text.as_str().unwrap(), japanese[key].as_str().unwrap());
        for form in text.split('|').chain(other.split('|')) {
            assert_eq!(places(form), places(text), "{key}: {form}");
        }
        assert!(text.split('|').count() <= 2 && !other.contains('|'), "{key}");
        assert!(!text.is_empty(), "{key}");
        // The wordless ones are the same; everything else has been translated.
        let words = text.chars().any(char::is_alphabetic) && key != "latex" && key != "equals" && key != "is";
        assert!(!words || text != other, "{key} is not translated");
    }
}

/// A template that asks for a word gets it, and no word is left that nobody asks for.
#[test]
fn templates_and_words_agree() {
    let code = sources(&folder().join("src/report"));
    agree(&table(Language::English), &asked("w.", |_| true), &code);
    for (name, table, templates) in tables_of_pages(Language::English) {
        let asked = asked("t.", |file| templates.contains(&file));
        assert!(templates.is_empty() || !asked.is_empty(), "{name}");
        agree(&table, &asked, &code);
    }
}

fn folder() -> &'static std::path::Path {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The words that templates ask for under a name.
fn asked(prefix: &str, wanted: impl Fn(&str) -> bool) -> HashSet<String> {
    let mut asked = HashSet::new();
    for file in std::fs::read_dir(folder().join("templates")).unwrap() {
        let path = file.unwrap().path();
        if !wanted(path.file_name().unwrap().to_str().unwrap()) {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let word = |rest: &str| rest.split(|c: char| !c.is_alphanumeric() && c != '_').next().map(str::to_owned);
        let begins = |before: &str| before.chars().next_back().is_none_or(|c| !c.is_alphanumeric() && c != '_');
        let found = text.match_indices(prefix).filter(|(k, _)| begins(&text[..*k]));
        asked.extend(found.filter_map(|(k, _)| word(&text[k + prefix.len()..])));
    }
    asked
}

/// All Rust of a folder, the tables of words themselves aside.
fn sources(folder: &std::path::Path) -> String {
    let mut code = String::new();
    for file in std::fs::read_dir(folder).unwrap() {
        let path = file.unwrap().path();
        match path.is_dir() {
            true if path.ends_with("words") => code.push_str(&std::fs::read_to_string(path.join("mod.rs")).unwrap()),
            true => code.push_str(&sources(&path)),
            false if path.extension().is_some_and(|e| e == "rs") => {
                code.push_str(&std::fs::read_to_string(path).unwrap());
            }
            false => {}
        }
    }
    code
}

fn agree(table: &Table, asked: &HashSet<String>, code: &str) {
    for key in asked {
        assert!(table.contains_key(key), "no word `{key}`");
    }
    for key in table.keys() {
        assert!(asked.contains(key) || code.contains(&format!(".{key}")), "nobody asks for `{key}`");
    }
}

#[test]
fn numbers_choose_the_form() {
    assert_eq!(
        ["{n} bit|{n} bits"; 3].map(|t| [count(t, 0), count(t, 1), count(t, 2)])[0],
        ["0 bits", "1 bit", "2 bits"]
    );
    assert_eq!(count("{n} 個", 1), "1 個");
    let hostile = "{n}|{m}";
    assert_eq!(with("a {x} b {y}", &[("x", &hostile), ("y", &1)]), "a {n}|{m} b 1");
}

#[test]
fn locales_have_a_language() {
    for (locale, tag) in
        [("ja_JP.UTF-8", "ja"), ("ja-JP", "ja"), ("JA", "ja"), ("C", "en"), ("de_DE", "en"), ("jam", "en"), ("", "en")]
    {
        assert_eq!(Language::of(locale).tag(), tag, "{locale}");
    }
}
