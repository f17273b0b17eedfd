//! Notes in LaTeX: which equations are found, what they are called, and where they stand.

use super::*;
use std::collections::HashMap;
use std::path::PathBuf;

/// Files that are beside the notes.
struct Folder(HashMap<PathBuf, String>);

impl Beside for Folder {
    fn text(&self, path: &Path) -> Option<String> {
        self.0.get(path).cloned()
    }
}

pub fn folder(files: &[(&str, &str)]) -> Document {
    let texts = files.iter().map(|(path, text)| (PathBuf::from(path), (*text).to_owned())).collect();
    let (main, text) = files[0];
    let document = parse_beside(Path::new(main), text, &Folder(texts));
    check_promises(&document);
    document
}

fn tex(source: &str) -> Document {
    folder(&[("notes.tex", source)])
}

fn article(body: &str) -> Document {
    tex(&format!("\\documentclass{{article}}\n\\begin{{document}}\n{body}\n\\end{{document}}\n"))
}

/// Labels, numbers and masked LaTeX.
fn found(document: &Document) -> Vec<String> {
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let line = |e: &Equation| format!("{} [{}] {}", e.label, e.numbers.join(" "), words(&e.masked));
    document.equations().map(line).collect()
}

#[test]
fn displays_of_all_kinds_are_found_and_numbered() {
    let document = article(
        r"
\begin{equation} a = 1 \end{equation}
\begin{equation*} a = 2 \end{equation*}
\begin{align} a &= 3 \\ b &= 4 \nonumber \\ c &= 5 \end{align}
\begin{gather} a = 6 \tag{A} \label{six} \end{gather}
\begin{multline} a = 7 \\ + 8 \end{multline}
\begin{eqnarray} a &=& 9 \label{nine} \\ b &=& 10 \label{ten} \end{eqnarray}
\begin{flalign*} a &= 11 & \end{flalign*}
\begin{alignat}{2} a &= 12 & b &= 13 \end{alignat}
\[ a = 14 \] text \[ a = 15
\]
$$ a = 16 $$
\begin{subequations} \begin{align} a &= 17 \label{x} \\ b &= 18 \label{y} \end{align} \end{subequations}
\begin{equation} \begin{split} a &= 19 \\ &= 20 \end{split} \end{equation}
",
    );
    assert_eq!(problems(&document), Vec::<String>::new());
    insta::assert_snapshot!(found(&document).join("\n"));
}

#[test]
fn what_is_not_read_holds_no_equations() {
    let document = tex(r"
\documentclass{article}
\newcommand{\x}{$$ a $$} \[ preamble \]
\begin{document}
% \[ b \]
\verb|$$| and \verb*+\[+ cost 5\$ and 5\% \\[2pt]
\begin{verbatim} \[ c \] % \end{verbatim}
\begin{lstlisting}[language=C] $$ d $$ \end{lstlisting}
\begin{comment} \[ e \] \end{comment}
\begin{equation} % \end{equation} \label{no}
  f = g % \\ \tag{1}
\end{equation}
\end{document}
\[ h \]
");
    assert_eq!(problems(&document), Vec::<String>::new());
    assert_eq!(found(&document), ["1 [1] f = g"]);
}

#[test]
fn sections_hold_declarations() {
    let document = article(
        "\\title{On \\emph{tops}\\thanks{me} and $x$}\n\\section*{One}\n%! kenzan\n%! [symbols]\n%! 'a' = { unit = 'm' }\n\
         \\[ a \\]\n%!given = ['1']\n  %! because = 'so'\n%!TEX program = lualatex\n\\subsection[short]{Two \\label{s}}\n\\begin{equation}b\\end{equation}",
    );
    assert_eq!(problems(&document), Vec::<String>::new());
    assert_eq!(document.title, "On tops and $x$");
    let items: Vec<_> = document
        .items
        .iter()
        .map(|item| match item {
            Item::Section(section) => format!("{} {}", section.level, section.title),
            Item::Declarations(declarations) => {
                let name = &declarations.symbols[0].names[0];
                assert_eq!(document.source.get(name.span.clone()), Some("a"));
                "declarations".to_owned()
            }
            Item::Equation(equation) => format!("{}: {}", equation.label, equation.annotation.is_some()),
        })
        .collect();
    assert_eq!(items, ["3 One", "declarations", "0+1: true", "4 Two", "1: false"]);
    let annotation = document.equations().next().unwrap().annotation.as_ref().unwrap();
    assert_eq!((annotation.given[0].as_str(), annotation.because.as_deref()), ("1", Some("so")));
}

#[test]
fn files_that_are_included_are_read_in_order() {
    let document = folder(&[
        (
            "course/notes.tex",
            "\\documentclass{book}\\usepackage{mine}\n\\begin{document}\n\\chapter{A}\n\\begin{equation}\\a\\end{equation}\n\\include{parts/one}\\input parts/two.tex\n\\begin{equation}d\\end{equation}\n\\end{document}",
        ),
        ("course/mine.sty", "\\newcommand{\\a}{x}\n\\[ not read \\]"),
        ("course/parts/one.tex", "\n\\begin{equation}b\\label{b}\\end{equation}\n\\import{sub}{three}"),
        ("course/parts/two.tex", "\\renewcommand\\a{y}\\begin{equation}\\a c\\end{equation}"),
        ("course/parts/sub/three.tex", "\\subfile{three} \\begin{equation}e = \\end{equation}"),
    ]);
    assert_eq!(
        problems(&document),
        [
            "course/parts/sub/three.tex:1:1: `course/parts/sub/three.tex` includes itself. it is read once; remove this line"
        ]
    );
    let places: Vec<_> = document
        .equations()
        .map(|e| (e.label.as_str(), e.file.as_deref().map(|p| p.to_str().unwrap()), e.line))
        .collect();
    let expected = [
        ("1.1", None, 4),
        ("b", Some("course/parts/one.tex"), 2),
        ("1.3", Some("course/parts/sub/three.tex"), 1),
        ("1.4", Some("course/parts/two.tex"), 1),
        ("1.5", None, 6),
    ];
    assert_eq!(places, expected);
    let expanded: Vec<_> = document.equations().map(|e| e.macros.expand(&e.masked).unwrap().text).collect();
    assert_eq!(expanded, ["x", &format!("b{}", " ".repeat(9)), "e =", "yc", "d"].map(|text| text.replace("yc", "y c")));
}

#[test]
fn problems_are_told_in_their_own_file() {
    let document = folder(&[
        (
            "notes.tex",
            "\\begin{equation} a \\label{a} \\end{equation}\n\\input{missing}\n\\input{more}\n\\input{/etc/passwd}",
        ),
        (
            "more.tex",
            "% 日本語\n\n日本 \\begin{align} b \\label{a} \\end{align}\n%! givne = ['1']\n\n\\begin{equation} c\n\nText.",
        ),
    ]);
    insta::assert_snapshot!(super::messages::rendered_all(&document));
}

#[test]
fn macros_for_environments_open_and_close_displays() {
    let document = article(
        "\\newcommand{\\beq}{\\begin{equation}}\\def\\eeq{\\end{equation}}\n\\newenvironment{eqn}{\\begin{align}}{\\end{align}}\n\
         \\beq a = b \\label{x} \\eeq\n\\begin{eqn} c &= d \\end{eqn}",
    );
    assert_eq!(found(&document), ["x [1] a = b", "2 [2] c &= d"]);
}

#[test]
fn displays_that_are_not_closed_cost_only_themselves() {
    let document = article("\\begin{align} a = b\n\nText \\[ c = d \\]\n\n$$ e \\section{F} \\[ g");
    assert_eq!(found(&document), ["0+1 [] c = d"]);
    assert_eq!(document.problems.len(), 3);
}

#[test]
fn numbers_follow_the_counter() {
    let document = article(
        "\\numberwithin{equation}{section}\\section{A}\\begin{equation}a\\end{equation}\\section*{B}\\begin{equation}b\\end{equation}\
         \\section{C}\\setcounter{equation}{6}\\begin{equation}\\label{c}c\\end{equation}",
    );
    assert_eq!(found(&document), ["1.1 [1.1] a", "1.2 [1.2] b", "c [2.7] c"]);
}

#[test]
fn references_to_labels_that_do_not_exist_are_warnings() {
    let body = "\\section{A}\\label{sec:a}\\begin{equation}\\label{eq:one}a\\end{equation}\n\\begin{figure}\\label{fig:b}\\end{figure}\n\
                See \\eqref{eq:one}, \\ref{sec:a}, \\cref{fig:b,eq:on}, Eq.~(1), \\eqref{eq:two} % \\eqref{no}\n";
    let document = article(body);
    let told: Vec<_> = document.problems.iter().map(|p| p.message.as_str()).collect();
    assert_eq!(told, ["there is no equation `eq:on`", "there is no equation `eq:two`"]);
    assert_eq!(
        article(&format!("{body} \\input{{missing}}")).problems.len(),
        1,
        "a file is missing that may hold them"
    );
}
