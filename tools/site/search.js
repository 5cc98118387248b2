// Search in the texts of all pages (index.js): every word must be in a section; headings, titles and keys count more.
(function () {
    const field = document.getElementById("search");
    const list = document.getElementById("found");
    const told = document.getElementById("told"); // read aloud as it changes
    const menu = document.getElementById("menu");
    const MOST = 20; // that are shown
    const base = document.body.dataset.base;

    // A key by its whole name: ice.fracture.brash is a row of the section ice.fracture of the input reference.
    function isKeyOf(word, heading, text) {
        const name = word.replace(/\[\w*\]/g, "").replace(/^vessels\./, "vessel.");
        const [, section, key] = name.match(/^(.+)\.(\w+)$/) ?? [];
        return Boolean(key) && heading.replaceAll("[]", "") === section && text.split(" ").includes(key);
    }

    function score(words, title, heading, text) {
        let sum = 0;
        for (const word of words) {
            if (isKeyOf(word, heading, text)) {
                sum += 20;
                continue;
            }
            if (!text.includes(word) && !title.includes(word)) return 0;
            sum += 1 + (heading.includes(word) ? 10 : 0) + (title.includes(word) ? 5 : 0);
            sum += Math.min(5, text.split(word).length - 1) / 5;
        }
        return sum;
    }

    function search(asked) {
        const words = asked.toLowerCase().split(/\s+/).filter(Boolean);
        if (!words.length) return [];
        const found = [];
        for (const page of pages)
            for (const [heading, anchor, text] of page.s) {
                const sum = score(words, page.t.toLowerCase(), heading.toLowerCase(), text.toLowerCase());
                if (sum) found.push({ sum, page, heading, anchor, text, word: words[0] });
            }
        return found.sort((a, b) => b.sum - a.sum).slice(0, MOST);
    }

    function show(found) {
        list.replaceChildren();
        for (const hit of found) {
            const item = document.createElement("li");
            const link = document.createElement("a");
            link.href = base + hit.page.a + (hit.anchor ? "#" + hit.anchor : "");
            link.textContent = hit.heading && hit.heading !== hit.page.t ? hit.page.t + ": " + hit.heading : hit.page.t;
            const around = document.createElement("small");
            const at = Math.max(0, hit.text.toLowerCase().indexOf(hit.word) - 40);
            around.textContent = hit.text.slice(at, at + 120);
            item.append(link, around);
            list.append(item);
        }
        const count = found.length === MOST ? `The best ${MOST}.` : `${found.length} found.`;
        told.textContent = found.length ? count : "Nothing found.";
    }

    field.addEventListener("input", () => {
        const asked = field.value.trim();
        list.hidden = !asked;
        menu.hidden = Boolean(asked);
        told.textContent = "";
        if (asked) show(search(asked));
        else list.replaceChildren();
    });
    document.addEventListener("keydown", (event) => {
        if (event.key === "/" && document.activeElement !== field) {
            event.preventDefault();
            field.focus();
        } else if (event.key === "Escape" && !list.hidden) {
            event.preventDefault();
            field.value = "";
            field.dispatchEvent(new Event("input"));
            field.focus();
        }
    });
})();
