// Made by web/tools/types.mjs from api/openapi/openapi.json. Do not edit.
export interface paths {
    "/v1/jobs": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Jobs, newest first */
        get: operations["listJobs"];
        put?: never;
        /** Hand in a request; answers with the result when it is done in time */
        post: operations["createJob"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/jobs/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the job */
                id: components["parameters"]["JobId"];
            };
            cookie?: never;
        };
        /** Status of a job; Prefer: wait=N waits for its end */
        get: operations["getJob"];
        put?: never;
        post?: never;
        /** Remove a job and its result; it is stopped first */
        delete: operations["deleteJob"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/jobs/{id}/result": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the job */
                id: components["parameters"]["JobId"];
            };
            cookie?: never;
        };
        /**
         * The result: JSON, or a table of it as CSV
         * @description The form is that of format, or the first of the Accept header that there is: application/json, text/csv.
         */
        get: operations["getResult"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/jobs/{id}/table.csv": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the job */
                id: components["parameters"]["JobId"];
            };
            cookie?: never;
        };
        /**
         * A table of the result as CSV, for programs that send an address only
         * @description As getResult with format=csv. A job that still runs is waited for, as long as createJob waits by default.
         */
        get: operations["getResultCsv"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/jobs/{id}/request": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the job */
                id: components["parameters"]["JobId"];
            };
            cookie?: never;
        };
        /** The request document as it was received */
        get: operations["getRequest"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/jobs/{id}/events": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the job */
                id: components["parameters"]["JobId"];
            };
            cookie?: never;
        };
        /**
         * Server-sent events: status, progress, critical_point, end
         * @description The data of status and end is a Job, of progress a JobProgressEvent, of points a PathPointsEvent, of critical_point a CriticalPointEvent. critical_point comes when the running analysis has found it (final: false, load_factor of the path's own mesh), and again for each point of the result when the job has ended (final: true).
         */
        get: operations["followJob"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/jobs/{id}/dismiss": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the job */
                id: components["parameters"]["JobId"];
            };
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Stop a job; repeatable */
        post: operations["dismissJob"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/sweeps": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Sweeps, newest first */
        get: operations["listSweeps"];
        put?: never;
        /** Hand in a sweep: one request document and what varies in it */
        post: operations["createSweep"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/sweeps/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
            };
            cookie?: never;
        };
        /** Status and counts of a sweep; Prefer: wait=N waits for its end */
        get: operations["getSweep"];
        put?: never;
        post?: never;
        /** Remove a sweep and its rows; it is dismissed first if need be */
        delete: operations["deleteSweep"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/sweeps/{id}/request": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
            };
            cookie?: never;
        };
        /** The sweep document as it was received */
        get: operations["getSweepRequest"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/sweeps/{id}/table": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
            };
            cookie?: never;
        };
        /** The rows that are there, in the order of points */
        get: operations["getSweepTable"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/sweeps/{id}/table.csv": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
            };
            cookie?: never;
        };
        /** The rows that are there as CSV, for programs that send an address only */
        get: operations["getSweepCsv"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/sweeps/{id}/points/{n}/request": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
                /** @description Number of the point, from 0 */
                n: components["parameters"]["PointNumber"];
            };
            cookie?: never;
        };
        /** The request document of a point */
        get: operations["getPointRequest"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/sweeps/{id}/points/{n}/job": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
                /** @description Number of the point, from 0 */
                n: components["parameters"]["PointNumber"];
            };
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Hand in the request of a point as a job, for its full result */
        post: operations["createPointJob"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/sweeps/{id}/events": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
            };
            cookie?: never;
        };
        /**
         * Server-sent events: status, progress, end
         * @description The data of status and end is a Sweep, of progress a SweepProgressEvent.
         */
        get: operations["followSweep"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/sweeps/{id}/dismiss": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
            };
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Stop a sweep; its rows stay; repeatable */
        post: operations["dismissSweep"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/sweeps/{id}/retry": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
            };
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Compute the failed and missing points of a failed or dismissed sweep again */
        post: operations["retrySweep"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/hops": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Every component of Grasshopper that the service has
         * @description The protocol of Hops. A list of functions that Hops shows as a menu; it needs no key, since Hops sends none.
         */
        get: operations["listComponents"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/hops/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the component */
                id: string;
            };
            cookie?: never;
        };
        /**
         * A component of Grasshopper: its inputs and outputs
         * @description The protocol of Hops. It needs no key, since Hops sends none.
         */
        get: operations["describeComponent"];
        put?: never;
        /**
         * Call a component: one analysis
         * @description The protocol of Hops. The component is that of the address, or of pointer when the name is solve.
         */
        post: operations["callComponent"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/solve": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Call the component that pointer names, where Hops posts every call to
         * @description The protocol of Hops, which calls components at the root of their host.
         */
        post: operations["callComponentByPointer"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/check": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Check a request or a sweep without storing it */
        post: operations["check"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/limits": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Every number that bounds the service */
        get: operations["getLimits"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/openapi.json": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** This document */
        get: operations["getDescription"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/examples": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Request documents to begin with */
        get: operations["getExamples"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/livez": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Whether the process serves */
        get: operations["isAlive"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/readyz": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Whether work should be sent here */
        get: operations["isReady"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/metrics": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Metrics of Prometheus */
        get: operations["getMetrics"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
}
export interface webhooks {
    ended: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** What the service sends to the callback of a job or sweep when it has ended (www.standardwebhooks.com) */
        post: operations["tellEnd"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
}
export interface components {
    schemas: {
        /** @description A name, unique within its list: 1 to 200 characters, none of them a control character */
        Id: string;
        /**
         * @description proportional: multiplied by the load factor; constant: acts in full before the load factor grows
         * @default proportional
         * @enum {string}
         */
        Pattern: "proportional" | "constant";
        /**
         * @description bilateral: pushes and pulls; compression_only: pushes only; tension_only: pulls only
         * @default bilateral
         * @enum {string}
         */
        Reaction: "bilateral" | "compression_only" | "tension_only";
        /**
         * @description A side of a member, looking from its start to its end; left is the side of its left normal
         * @default left
         * @enum {string}
         */
        Side: "left" | "right";
        /** @description A place on the structure: a node, or any point of a member */
        Location: {
            /** @description Id of the node */
            node: components["schemas"]["Id"];
        } | {
            /** @description Id of the member */
            member: components["schemas"]["Id"];
            /** @description How far along the member, from its start */
            fraction: number;
        };
        /** @description A direction [dx, dy] in global axes; only its direction counts */
        Direction: [
            number,
            number
        ];
        /**
         * @description A part [f0, f1] of a member, f0 < f1
         * @default [
         *       0,
         *       1
         *     ]
         */
        Range: [
            number,
            number
        ];
        /** @description A point that members join */
        Node: {
            /** @description Name of the node */
            id: components["schemas"]["Id"];
            /** @description Global x, to the right */
            x: number;
            /** @description Global y, up */
            y: number;
        };
        /** @description Stiffness of a member: by stiffness, or by material and shape */
        Section: {
            /** @description Name of the section */
            id: components["schemas"]["Id"];
            /** @description Axial stiffness */
            EA: number;
            /** @description Bending stiffness */
            EI: number;
            /** @description Shear stiffness with the shear area; without it the section does not shear */
            GA?: number;
        } | {
            /** @description Name of the section */
            id: components["schemas"]["Id"];
            /** @description Young's modulus */
            E: number;
            /** @description Area */
            A: number;
            /** @description Second moment of area */
            I: number;
            /** @description Poisson's ratio; needed with shear_area */
            nu?: number;
            /** @description Area that shears; without it the section does not shear */
            shear_area?: number;
        };
        /** @description Axis of a member from its start to its end */
        Curve: {
            /**
             * @description A straight line
             * @constant
             */
            type: "line";
        } | {
            /**
             * @description A circular arc
             * @constant
             */
            type: "arc";
            /** @description Angle that the axis turns by from start to end, positive to the left, not 0 */
            sweep_degrees: number;
        } | {
            /**
             * @description A parabola over the chord
             * @constant
             */
            type: "parabola";
            /** @description Rise along the left normal of the chord */
            rise: number;
        } | {
            /**
             * @description Half waves of a sine over the chord
             * @constant
             */
            type: "sine";
            /** @description Rise along the left normal of the chord */
            rise: number;
            /**
             * @description Number of half waves
             * @default 1
             */
            half_waves?: number;
        } | {
            /**
             * @description A smooth spline from start to end
             * @constant
             */
            type: "points";
            /** @description Interior points [x, y] in order */
            points: [
                number,
                number
            ][];
        };
        /** @description A beam between two nodes */
        Member: {
            /** @description Name of the member */
            id: components["schemas"]["Id"];
            /** @description Id of the node that s is counted from */
            start: components["schemas"]["Id"];
            /** @description Id of the other node */
            end: components["schemas"]["Id"];
            /** @description Id of the section */
            section: components["schemas"]["Id"];
            /** @description Axis of the member; a straight line when left out */
            curve?: components["schemas"]["Curve"];
            /** @description Internal hinges */
            release?: {
                /**
                 * @description Released at the start: rotation makes a hinge
                 * @default []
                 */
                start?: "rotation"[];
                /**
                 * @description Released at the end: rotation makes a hinge
                 * @default []
                 */
                end?: "rotation"[];
            };
        };
        /** @description A node that is held */
        Support: {
            /** @description Id of the node that is held; one support a node */
            node: components["schemas"]["Id"];
            /** @description Components that are held, in the support's own axes */
            fixed: ("x" | "y" | "rotation")[];
            /**
             * @description Angle of the support's x axis to the global one, counter-clockwise
             * @default 0
             */
            angle_degrees?: number;
            /** @description Prescribed values of fixed components */
            displacement?: {
                /**
                 * @description Prescribed displacement along the support's x
                 * @default 0
                 */
                x?: number;
                /**
                 * @description Prescribed displacement along the support's y
                 * @default 0
                 */
                y?: number;
                /**
                 * @description Prescribed rotation, counter-clockwise
                 * @default 0
                 */
                rotation?: number;
                /** @description What multiplies the displacement */
                pattern?: components["schemas"]["Pattern"];
            };
        } | {
            /** @description Id of the node that is held; one support a node */
            node: components["schemas"]["Id"];
            /** @description Components that are held, in the support's own axes */
            fixed: ("x" | "y" | "rotation")[];
            /**
             * @description Angle of the support's x axis to the global one, counter-clockwise
             * @default 0
             */
            angle_degrees?: number;
            /** @description Prescribed values of fixed components */
            displacement: {
                /**
                 * @description Prescribed displacement along the support's x
                 * @default 0
                 */
                x?: number;
                /**
                 * @description Prescribed displacement along the support's y
                 * @default 0
                 */
                y?: number;
                /**
                 * @description Prescribed rotation, counter-clockwise
                 * @default 0
                 */
                rotation?: number;
            };
            /** @description What multiplies the displacement */
            pattern: components["schemas"]["Pattern"];
        };
        /** @description A discrete elastic spring to the ground */
        Spring: {
            /** @description Name of the spring */
            id: components["schemas"]["Id"];
            /** @description Where it is attached */
            at: components["schemas"]["Location"];
            /** @description Along a direction that points into the medium, or rotation for a rotational spring */
            direction: components["schemas"]["Direction"] | "rotation";
            /** @description Stiffness */
            stiffness: number;
            /** @description What it can do */
            reaction?: components["schemas"]["Reaction"];
            /**
             * @description Free travel before a one-sided spring reacts; needs a one-sided reaction
             * @default 0
             */
            gap?: number;
        };
        /** @description A continuous elastic base along a member */
        Foundation: {
            /** @description Name of the foundation */
            id: components["schemas"]["Id"];
            /** @description Id of the member that it lies along */
            member: components["schemas"]["Id"];
            /** @description Winkler modulus K of the reaction r = K w - G w'' per undeformed length */
            stiffness: number;
            /**
             * @description Stiffness G of the shear layer (Pasternak, Filonenko-Borodich); needs a bilateral reaction
             * @default 0
             */
            shear_stiffness?: number;
            /** @description What it can do */
            reaction?: components["schemas"]["Reaction"];
            /** @description Part of the member that it lies along */
            range?: components["schemas"]["Range"];
            /**
             * @description Free travel before a one-sided foundation reacts; needs a one-sided reaction
             * @default 0
             */
            gap?: number;
            /**
             * @description Along the initial normal of the member
             * @default normal
             * @constant
             */
            direction?: "normal";
            /** @description Where the medium lies */
            side?: components["schemas"]["Side"];
        } | {
            /** @description Name of the foundation */
            id: components["schemas"]["Id"];
            /** @description Id of the member that it lies along */
            member: components["schemas"]["Id"];
            /** @description Winkler modulus K of the reaction r = K w - G w'' per undeformed length */
            stiffness: number;
            /**
             * @description Stiffness G of the shear layer (Pasternak, Filonenko-Borodich); needs a bilateral reaction
             * @default 0
             */
            shear_stiffness?: number;
            /** @description What it can do */
            reaction?: components["schemas"]["Reaction"];
            /** @description Part of the member that it lies along */
            range?: components["schemas"]["Range"];
            /**
             * @description Free travel before a one-sided foundation reacts; needs a one-sided reaction
             * @default 0
             */
            gap?: number;
            /** @description Points into the medium */
            direction: components["schemas"]["Direction"];
        };
        /** @description An action on the structure */
        Load: {
            /**
             * @description At a point
             * @constant
             */
            type: "point";
            /** @description Where it acts */
            at: components["schemas"]["Location"];
            /** @description Force [fx, fy] in global axes */
            force: [
                number,
                number
            ];
            /**
             * @description Moment, counter-clockwise
             * @default 0
             */
            moment?: number;
            /** @description What multiplies the load */
            pattern?: components["schemas"]["Pattern"];
        } | {
            /**
             * @description Along a member
             * @constant
             */
            type: "distributed";
            /** @description Id of the member that it acts on */
            member: components["schemas"]["Id"];
            /** @description Load [qx, qy] in global axes */
            force: [
                number,
                number
            ];
            /** @description Part of the member */
            range?: components["schemas"]["Range"];
            /**
             * @description Length that the load is counted by: of the undeformed axis, or of its projection
             * @default length
             * @enum {string}
             */
            per?: "length" | "horizontal" | "vertical";
            /** @description What multiplies the load */
            pattern?: components["schemas"]["Pattern"];
        } | {
            /**
             * @description A follower pressure
             * @constant
             */
            type: "pressure";
            /** @description Id of the member that it acts on */
            member: components["schemas"]["Id"];
            /** @description Pressure, per deformed length, across the deformed axis */
            value: number;
            /** @description The side that it pushes from */
            side?: components["schemas"]["Side"];
            /** @description What multiplies the load */
            pattern?: components["schemas"]["Pattern"];
        } | {
            /**
             * @description A strain
             * @constant
             */
            type: "initial_strain";
            /** @description Id of the member that it acts on */
            member: components["schemas"]["Id"];
            /**
             * @description Axial strain, extension positive
             * @default 0
             */
            axial?: number;
            /**
             * @description Curvature, to the left positive
             * @default 0
             */
            curvature?: number;
            /** @description What multiplies the load */
            pattern?: components["schemas"]["Pattern"];
        };
        /** @description A stress-free offset of the axis along its left normal; several add up */
        Imperfection: {
            /**
             * @description Half waves of a sine
             * @constant
             */
            type: "sine";
            /** @description Id of the member that it acts on */
            member: components["schemas"]["Id"];
            /** @description Number of half waves */
            half_waves: number;
            /** @description Largest offset along the left normal */
            amplitude: number;
        } | {
            /**
             * @description A linearised buckling mode
             * @constant
             */
            type: "mode";
            /** @description Which mode; 1 is that of the lowest load */
            number: number;
            /** @description Largest offset along the left normal */
            amplitude: number;
        } | {
            /**
             * @description Offsets at points
             * @constant
             */
            type: "points";
            /** @description Id of the member that it acts on */
            member: components["schemas"]["Id"];
            /** @description Pairs [fraction, offset], fractions increasing */
            offsets: [
                number,
                number
            ][];
        };
        /** @description A displacement that is recorded at every step */
        Monitor: {
            /** @description Name of the monitor */
            id: components["schemas"]["Id"];
            /** @description Where */
            at: components["schemas"]["Location"];
            /**
             * @description Which displacement; normal is along the initial left normal and needs a place on a member
             * @enum {string}
             */
            component: "x" | "y" | "rotation" | "normal";
        };
        /** @description Labels of units by quantity, such as {"length": "m"}; echoed, never interpreted */
        Units: {
            [key: string]: string;
        };
        /** @description The structure, what holds it and what acts on it, in one consistent set of units */
        Model: {
            /**
             * @description A title, echoed in the result
             * @default
             */
            title?: string;
            /** @description Labels of the units */
            units?: components["schemas"]["Units"];
            /** @description Points that members join; each is the end of a member */
            nodes: components["schemas"]["Node"][];
            /** @description Stiffnesses of members */
            sections: components["schemas"]["Section"][];
            /** @description Beams */
            members: components["schemas"]["Member"][];
            /**
             * @description Nodes that are held; supports, springs or foundations must hold the structure
             * @default []
             */
            supports?: components["schemas"]["Support"][];
            /**
             * @description Discrete springs to the ground
             * @default []
             */
            springs?: components["schemas"]["Spring"][];
            /**
             * @description Continuous elastic bases
             * @default []
             */
            foundations?: components["schemas"]["Foundation"][];
            /**
             * @description Actions; one must be proportional and not zero unless the analysis is static
             * @default []
             */
            loads?: components["schemas"]["Load"][];
            /**
             * @description Stress-free offsets of the axes
             * @default []
             */
            imperfections?: components["schemas"]["Imperfection"][];
            /**
             * @description Displacements that are recorded
             * @default []
             */
            monitors?: components["schemas"]["Monitor"][];
        };
        /** @description How fine the mesh is: an accuracy, or a fixed mesh */
        Discretization: {
            /**
             * @description Relative error wanted in every load factor
             * @default 0.001
             */
            accuracy?: number;
        } | {
            /** @description Number of elements: on every member, or by member (all members named) */
            elements: number | {
                [key: string]: number;
            };
            /**
             * @description Polynomial order of the elements
             * @default 1
             */
            order?: number;
            /**
             * @description consistent: integrated along the elements; lumped: springs at the nodes
             * @default consistent
             * @enum {string}
             */
            foundation?: "consistent" | "lumped";
        };
        /** @description Lengths of the steps along a path; by default they are chosen and adapted */
        Step: {
            /** @description First step */
            initial?: number;
            /** @description Smallest step before the path counts as stuck */
            min?: number;
            /** @description Largest step */
            max?: number;
            /**
             * @description path: how the load factor begins to change: 1 grows, -1 falls
             * @default 1
             * @enum {integer}
             */
            direction?: 1 | -1;
        };
        /** @description The fields of a state of a result (states[n]) that a path needs to begin with it */
        StartState: {
            /** @description Load factor of the state, at which its equilibrium is found again */
            load_factor: number;
            /** @description By member id, each member of the model */
            members: {
                [key: string]: components["schemas"]["StartShape"];
            };
        };
        /** @description Displacements and section forces of a member, a number for each place; splines join them */
        StartShape: {
            /** @description Arc lengths of the places along the perfect axis, growing, from 0 to the member's length */
            s: number[];
            /** @description Displacements along x */
            u: number[];
            /** @description Displacements along y */
            v: number[];
            /** @description Rotations */
            rotation: number[];
            /** @description Axial forces */
            axial_force: number[];
            /** @description Shear forces */
            shear_force: number[];
            /** @description Bending moments */
            bending_moment: number[];
        };
        /** @description Where a path ends: the first rule to be met */
        Stop: {
            /** @description After this many limit points */
            limit_points?: number;
            /** @description When the load factor leaves [lo, hi] */
            load_factor?: [
                number,
                number
            ];
            /** @description When a monitor leaves its range */
            monitor?: {
                /** @description Id of the monitor */
                id: components["schemas"]["Id"];
                /** @description [lo, hi] */
                range: [
                    number,
                    number
                ];
            };
            /** @description After this many steps */
            steps?: number;
            /** @description At the first point of a path with more negative eigenvalues than this. Where neither this nor load_factor nor steps is given, a path ends with 10 more than at its start, and one more for each of limit_points, unless the monitor moves */
            negative_eigenvalues?: number;
        };
        /** @description What of the analysis is given back */
        Output: {
            /** @description Where full states (shape, forces, reactions) are given */
            states?: ("none" | "critical" | "all") | {
                /** @description States are given at every so many points */
                every: number;
            } | {
                /** @description Load factors at which the path is cut; those that are not reached are listed in not_reached */
                at_load_factors: number[];
            };
            /**
             * @description Points along a member in states and modes; times members at most 2000000
             * @default 101
             */
            points_per_member?: number;
            /** @description At least this many points of each path, evenly along the arc, for smooth plots; without it the points are those of the steps */
            path_points?: number;
            /**
             * @description Whether the largest and smallest forces and displacements of each member are given
             * @default false
             */
            extremes?: boolean;
        };
        /** @description What is computed */
        Analysis: {
            /**
             * @description critical: the first loss of stability on the path from the unloaded state; path: the equilibrium path; buckling: linearised eigenvalues about the reference load; static: equilibrium at load_factors
             * @enum {string}
             */
            type: "buckling" | "critical" | "path" | "static";
            /**
             * @description buckling: how many loads and modes; with reversed so many of each sign
             * @default 1
             */
            modes?: number;
            /**
             * @description buckling: whether loads of the opposite actions count, too, as negative load factors; needs bilateral springs and foundations
             * @default false
             */
            reversed?: boolean;
            /**
             * @description static: where equilibrium is wanted
             * @default [
             *       1
             *     ]
             */
            load_factors?: number[];
            /** @description path: the state that the path begins with, such as one of a branch that no path from the unloaded state reaches; by default the unloaded state or that of the constant actions */
            start?: components["schemas"]["StartState"];
            /**
             * @description static, nonlinear: what is done where the path loses stability before an asked load factor. refuse: the analysis ends there with the failure beyond_critical_point; follow: rows beyond a bifurcation are given, with their counts and a warning
             * @default refuse
             * @enum {string}
             */
            unstable?: "refuse" | "follow";
            /**
             * @description nonlinear: large displacements; linear: small ones, for static only
             * @default nonlinear
             * @enum {string}
             */
            geometry?: "nonlinear" | "linear";
            /** @description The mesh; an accuracy of 1e-3 when left out */
            discretization?: components["schemas"]["Discretization"];
            /** @description path: what is increased from step to step */
            control?: ("arc_length" | "load") | {
                /** @description Id of the monitor */
                displacement: components["schemas"]["Id"];
            };
            /** @description path: lengths of the steps */
            step?: components["schemas"]["Step"];
            /** @description path: where it ends */
            stop?: components["schemas"]["Stop"];
            /** @description path: which bifurcated branches are followed */
            branches?: {
                /**
                 * @description primary: none; first: those of the first bifurcation; all
                 * @default primary
                 * @enum {string}
                 */
                follow?: "primary" | "first" | "all";
                /** @description At most this many branches */
                limit?: number;
            };
            /** @description What is given back */
            output?: components["schemas"]["Output"];
            /**
             * @description critical, path: numbers of the model by which the load factor of each critical point is differentiated
             * @default []
             */
            sensitivities?: string[];
            /**
             * @description critical, path: Koiter's coefficients of bifurcations
             * @default false
             */
            koiter?: boolean;
        };
        /** @description A structure and what to analyse about it. Rules of more than one field (references, mechanics) are checked beyond this schema; see docs/requests.md. */
        Request: {
            /** @description The structure */
            model: components["schemas"]["Model"];
            /** @description What to compute */
            analysis: components["schemas"]["Analysis"];
        };
        /**
         * @description bifurcation: another path crosses; limit_max, limit_min: the load has a maximum, a minimum; broken_bifurcation: a bifurcation beside the path, which passes it by because of an imperfection
         * @enum {string}
         */
        CriticalType: "bifurcation" | "limit_max" | "limit_min" | "broken_bifurcation";
        /** @description What most readers want */
        Summary: {
            /** @description Load factor at which the path from the unloaded state first loses stability, confirmed; positive unless analysis.step.direction is -1; null when there is none. buckling: the lowest positive one */
            critical_load_factor: number | null;
            /** @description Kind of that critical point; null when there is none */
            critical_type: components["schemas"]["CriticalType"] | null;
            /** @description Estimated relative error of that load factor; null when none was made */
            error_estimate: number | null;
            /** @description Where the stiffness ratio has its first local minimum below a tenth before the critical load factor, else its lowest; the critical point itself where it has no minimum; null when neither was met */
            softest: components["schemas"]["Softest"] | null;
            /** @description How far the structure has moved at the critical load factor; null when there is none, and in linearised analyses */
            at_critical: components["schemas"]["AtCritical"] | null;
            /**
             * @description Code of what ended the analysis; see docs/requests.md, How an analysis ends
             * @enum {string}
             */
            termination: "critical_point" | "unstable_at_start" | "limit_points" | "load_factor" | "load_factors" | "monitor" | "monitor_turned" | "rejoined" | "steps" | "negative_eigenvalues" | "displacement_bound" | "load_bound" | "modes" | "no_buckling" | "not_confirmed" | "step_underflow" | "no_start" | "loose_part" | "not_held" | "constant_actions" | "constant_actions_limit" | "no_convergence" | "beyond_limit_point" | "beyond_critical_point" | "fewer_modes" | "no_buckling_mode" | "mechanism" | "cancelled";
            /** @description The same as a sentence with the deciding numbers */
            message: string;
        };
        /** @description Where the structure is softest before it loses stability */
        Softest: {
            /** @description Load factor there, on the path's mesh */
            load_factor: number;
            /** @description Least stiffness there over that of the unloaded structure; 0 at a critical point */
            stiffness_ratio: number;
            /** @description The motion with that stiffness; null when no modes or states are asked for */
            mode: components["schemas"]["Mode"] | null;
        };
        /** @description Largest movements of the state at the critical load factor */
        AtCritical: {
            /** @description Largest hypot(u, v) */
            displacement: number;
            /** @description The same over the diagonal of the structure's bounding box */
            relative_displacement: number;
            /** @description Largest rotation, of either sense */
            rotation: number;
            /** @description Largest of |N| / EA, |Q| / GA and |M| / EI times sqrt(EI / EA) */
            strain: number;
        };
        /** @description A mode along a member; lists of equal length */
        ModeMember: {
            /** @description Undeformed arc length from the start of the member */
            s: number[];
            /** @description Displacement along global x, scaled */
            u: number[];
            /** @description Displacement along global y, scaled */
            v: number[];
            /** @description Rotation, counter-clockwise, scaled */
            rotation: number[];
        };
        /** @description A shape of displacements: the largest displacement is 1, its larger component positive */
        Mode: {
            /** @description The shape by id of the member */
            members: {
                [key: string]: components["schemas"]["ModeMember"];
            };
        };
        /** @description What one mesh said of a critical point */
        MeshLoad: {
            /** @description Elements of the mesh */
            elements: number;
            /** @description Polynomial order of its elements */
            order: number;
            /** @description Load factor there; null: nothing was found there */
            load_factor: number | null;
        };
        /** @description A point of a path where stability changes */
        CriticalPoint: {
            /** @description Index of the branch in branches */
            branch: number;
            /** @description Kind of the point */
            type: components["schemas"]["CriticalType"];
            /**
             * @description smooth: an eigenvalue passes zero; contact: a support that begins or ceases to act changes the stiffness
             * @enum {string}
             */
            cause: "smooth" | "contact";
            /** @description Load factor */
            load_factor: number;
            /** @description Estimated relative error of the load factor; null when none was made */
            error_estimate: number | null;
            /** @description Whether a finer mesh found the point within the asked accuracy */
            confirmed: boolean;
            /** @description What each mesh said, coarsest first */
            meshes: components["schemas"]["MeshLoad"][];
            /** @description Arc length of the path up to the point */
            arc_length: number;
            /** @description Values of monitors there, by id */
            monitors: {
                [key: string]: number;
            };
            /** @description Negative eigenvalues of the tangent stiffness before the point; null when not counted */
            negative_before: number | null;
            /** @description The same after the point */
            negative_after: number | null;
            /** @description How many eigenvalues vanish there */
            multiplicity: number;
            /** @description Of a bifurcation: the size of what breaks it, about the root mean square slope of the imperfection along its mode; null where it was not measured */
            imperfection: number | null;
            /** @description Index of the point's state in states; null when there is none */
            state: number | null;
            /** @description The member whose own buckling the point is: nine tenths of the strain energy of the motion lost there are its; null where that is no single member's */
            member: components["schemas"]["Id"] | null;
            /** @description The null vector at a bifurcation, the path's direction at a limit point; null without a state */
            mode: components["schemas"]["Mode"] | null;
            /** @description In the order of analysis.sensitivities; absent where none were asked for */
            sensitivities?: components["schemas"]["Sensitivity"][];
            /** @description load_factor (1 + a s + b s^2) along the path that crosses, s the amplitude of the mode; null where it has none; absent where it was not asked for */
            koiter?: components["schemas"]["Koiter"] | null;
        };
        /** @description How the path that crosses leaves a simple bifurcation */
        Koiter: {
            /** @description 0 at a symmetric bifurcation */
            a: number;
            /** @description Null at an asymmetric bifurcation */
            b: number | null;
            /**
             * @description asymmetric: an imperfection takes away by its power 1/2; stable_symmetric: the state at the load itself is stable; unstable_symmetric: an imperfection takes away by its power 2/3
             * @enum {string}
             */
            kind: "asymmetric" | "stable_symmetric" | "unstable_symmetric";
        };
        /** @description Derivative of a critical load factor */
        Sensitivity: {
            /** @description The number of the model, as asked */
            pointer: string;
            /** @description d load_factor / d value, on the mesh of the load factor; null where there is none */
            derivative: number | null;
            /**
             * @description Why there is none. breaks_bifurcation: the path no longer meets the point, and its load falls by a power less than one; contact: a support that begins or ceases to act makes the point; multiple: several eigenvalues vanish there and go apart; unsymmetric: follower pressure acts on a free end; not_differentiable: the equations have a kink or a jump there; not_found: the point could not be found again to rounding
             * @enum {string|null}
             */
            reason: "breaks_bifurcation" | "contact" | "multiple" | "unsymmetric" | "not_differentiable" | "not_found" | null;
        };
        /** @description Motion of a node */
        NodeMotion: {
            /** @description Along global x, scaled */
            u: number;
            /** @description Along global y, scaled */
            v: number;
            /** @description Rotation, counter-clockwise, scaled */
            rotation: number;
        };
        /** @description A motion that meets no stiffness along a part of a path: it is held by the least norm, and stability is counted on the rest */
        NeutralMotion: {
            /** @description Index of the branch in branches */
            branch: number;
            /** @description Load factor where it begins */
            from: number;
            /** @description Load factor where it ends; null: with the path */
            to: number | null;
            /** @description Motion by id of the node */
            nodes: {
                [key: string]: components["schemas"]["NodeMotion"];
            };
        };
        /** @description Contact that begins or ends somewhere */
        ContactEvent: {
            /** @description Index of the branch in branches */
            branch: number;
            /** @description Id of the foundation or of the one-sided spring */
            id: components["schemas"]["Id"];
            /**
             * @description opened: contact was lost; closed: contact was made
             * @enum {string}
             */
            type: "opened" | "closed";
            /** @description Load factor */
            load_factor: number;
            /** @description Arc length of the path up to the event */
            arc_length: number;
            /** @description Contact zones before */
            zones_before: number;
            /** @description Contact zones after */
            zones_after: number;
        };
        /** @description An equilibrium path; its lists have one entry a point */
        Branch: {
            /** @description Number of the branch; 0 is the primary path */
            id: number;
            /** @description Branch that it bifurcates from; null for the primary path */
            parent: number | null;
            /** @description Load factors */
            load_factor: number[];
            /** @description Arc length from the branch's first point, increasing */
            arc_length: number[];
            /** @description Displacements of monitors, by id */
            monitors: {
                [key: string]: number[];
            };
            /** @description Negative eigenvalues of the constrained tangent stiffness; 0 is stable */
            negative_eigenvalues: number[];
            /** @description Least stiffness over that of the unloaded structure: 1 unloaded, 0 at a critical point; null where it is not known */
            stiffness_ratio: (number | null)[];
            /** @description How much of each foundation is in contact, by id */
            contact_fraction: {
                [key: string]: number[];
            };
            /**
             * @description Code of what ended the branch
             * @enum {string}
             */
            termination: "critical_point" | "unstable_at_start" | "limit_points" | "load_factor" | "load_factors" | "monitor" | "monitor_turned" | "rejoined" | "steps" | "negative_eigenvalues" | "displacement_bound" | "load_bound" | "modes" | "no_buckling" | "not_confirmed" | "step_underflow" | "no_start" | "loose_part" | "not_held" | "constant_actions" | "constant_actions_limit" | "no_convergence" | "beyond_limit_point" | "beyond_critical_point" | "fewer_modes" | "no_buckling_mode" | "mechanism" | "cancelled";
        };
        /** @description A member in a state; lists of equal length, points_per_member entries */
        MemberState: {
            /** @description Undeformed arc length from the start of the member */
            s: number[];
            /** @description Global x of the undeformed axis */
            x0: number[];
            /** @description Global y of the undeformed axis */
            y0: number[];
            /** @description Global x of the deformed axis */
            x: number[];
            /** @description Global y of the deformed axis */
            y: number[];
            /** @description Displacement along global x */
            u: number[];
            /** @description Displacement along global y */
            v: number[];
            /** @description Rotation of the cross-section, counter-clockwise */
            rotation: number[];
            /** @description N, along the deformed tangent of the section, tension positive */
            axial_force: number[];
            /** @description Q, along the deformed left normal, of the part beyond on the part before */
            shear_force: number[];
            /** @description M, positive when it turns the member to its left as s grows */
            bending_moment: number[];
        };
        /** @description What a support does to the structure, in global axes */
        SupportReaction: {
            /** @description Force along global x of the support on the structure */
            fx: number;
            /** @description Force along global y of the support on the structure */
            fy: number;
            /** @description Moment of the support on the structure, counter-clockwise */
            moment: number;
        };
        /** @description A spring in a state */
        SpringState: {
            /** @description What the spring presses on the structure against its direction: positive when the medium pushes back, negative when it pulls */
            force: number;
            /** @description Displacement along its direction; rotation for a rotational one */
            displacement: number;
            /** @description Whether it acts */
            closed: boolean;
            /** @description Force of the spring on the structure */
            resultant: components["schemas"]["Resultant"];
        };
        /** @description Sum of forces, with its moment about the origin of the model's axes at the deformed positions (undeformed when geometry is linear) */
        Resultant: {
            /** @description Force along global x on the structure */
            fx: number;
            /** @description Force along global y on the structure */
            fy: number;
            /** @description Moment about the origin, counter-clockwise */
            moment: number;
        };
        /** @description A foundation in a state */
        FoundationState: {
            /** @description Undeformed arc length of the member */
            s: number[];
            /** @description Reaction per undeformed length, positive when the medium pushes on the structure */
            reaction: number[];
            /** @description Displacement into the medium */
            displacement: number[];
            /** @description Intervals in contact */
            contact: [
                number,
                number
            ][];
            /** @description Force of the medium on the structure, shear layer included */
            resultant: components["schemas"]["Resultant"];
        };
        /** @description An equilibrium state. Supports (with their moment arms), springs, foundations and loads add up to zero. */
        State: {
            /** @description Index of the branch in branches */
            branch: number;
            /** @description Load factor */
            load_factor: number;
            /** @description How often the path's mesh was refined for this state */
            refinements: number;
            /** @description Shape and forces by id of the member */
            members: {
                [key: string]: components["schemas"]["MemberState"];
            };
            /** @description Reactions by id of the node that is held */
            supports: {
                [key: string]: components["schemas"]["SupportReaction"];
            };
            /** @description Springs by id */
            springs: {
                [key: string]: components["schemas"]["SpringState"];
            };
            /** @description Foundations by id */
            foundations: {
                [key: string]: components["schemas"]["FoundationState"];
            };
            /** @description Resultant of all loads that act in the state */
            loads: components["schemas"]["Resultant"];
        };
        /** @description Equilibrium at the load factors that were asked for and reached, in the order asked; lists have one entry a load factor */
        Static: {
            /** @description Load factors */
            load_factor: number[];
            /** @description Displacements of monitors, by id */
            monitors: {
                [key: string]: number[];
            };
            /** @description Negative eigenvalues of the constrained tangent stiffness; 0 is stable, null not counted */
            negative_eigenvalues: (number | null)[];
            /** @description How much of each foundation is in contact, by id */
            contact_fraction: {
                [key: string]: number[];
            };
            /** @description Index in states; null when there is none */
            state: (number | null)[];
        };
        /** @description Linearised buckling about the reference load */
        Buckling: {
            /** @description Buckling loads, increasing in size; negative ones, of the opposite actions, where analysis.reversed asks for them; empty where the constant actions alone exceed buckling loads */
            load_factors: number[];
            /** @description Estimated relative error of each; null when none was made */
            error_estimates: (number | null)[];
            /** @description Mode of each */
            modes: components["schemas"]["Mode"][];
        };
        /** @description An extreme value of a force and where it is */
        ForceExtreme: {
            /** @description The value */
            value: number;
            /** @description Undeformed arc length where it is */
            s: number;
            /** @description Index of the branch in branches */
            branch: number;
            /** @description Load factor at which it is */
            load_factor: number;
        };
        /** @description An extreme value of a moment and where it is */
        MomentExtreme: {
            /** @description The value */
            value: number;
            /** @description Undeformed arc length where it is */
            s: number;
            /** @description Index of the branch in branches */
            branch: number;
            /** @description Load factor at which it is */
            load_factor: number;
        };
        /** @description An extreme value of a displacement and where it is */
        DisplacementExtreme: {
            /** @description The value */
            value: number;
            /** @description Undeformed arc length where it is */
            s: number;
            /** @description Index of the branch in branches */
            branch: number;
            /** @description Load factor at which it is */
            load_factor: number;
        };
        /** @description Extremes of a member */
        MemberExtremes: {
            /** @description Axial force N */
            axial_force: {
                /** @description Smallest value */
                min: components["schemas"]["ForceExtreme"];
                /** @description Largest value */
                max: components["schemas"]["ForceExtreme"];
            };
            /** @description Shear force Q */
            shear_force: {
                /** @description Smallest value */
                min: components["schemas"]["ForceExtreme"];
                /** @description Largest value */
                max: components["schemas"]["ForceExtreme"];
            };
            /** @description Bending moment M */
            bending_moment: {
                /** @description Smallest value */
                min: components["schemas"]["MomentExtreme"];
                /** @description Largest value */
                max: components["schemas"]["MomentExtreme"];
            };
            /** @description Displacement hypot(u, v) */
            displacement: {
                /** @description Largest value */
                max: components["schemas"]["DisplacementExtreme"];
            };
        };
        /** @description Extremes over all states and all points of paths up to the first critical load (of the whole path when there is none) */
        Extremes: {
            /** @description By id of the member */
            members: {
                [key: string]: components["schemas"]["MemberExtremes"];
            };
        };
        /** @description Something that the reader of the result must know */
        Warning: {
            /**
             * @description large_strain: strains beyond 0.05, where the elastic law for small strains is not valid; touching_supports: supports touch without pressure, and it is not certain that no motion has a lower load; touching_eigenvalue: a stiffness falls to zero within rounding and rises again, and whether two critical points lie there cannot be told; path_points: a path has fewer points than asked for; monitor_still: the monitor of a stop rule does not move on any path that was followed, so that the rule could not act; contact_changes: a linearised analysis keeps the contact of its reference load, and under the critical load one-sided supports touch elsewhere; nearly_unstable: the stiffness ratio falls below a tenth before the critical load factor; unstable: rows of a static analysis are unstable equilibria
             * @enum {string}
             */
            code: "large_strain" | "touching_supports" | "touching_eigenvalue" | "path_points" | "monitor_still" | "contact_changes" | "nearly_unstable" | "unstable";
            /** @description Where and how much */
            detail: string;
        };
        /** @description The mesh of the result */
        MeshReport: {
            /** @description Elements; null when the analysis has none */
            elements: number | null;
            /** @description Polynomial order of the elements; null when the analysis has none */
            order: number | null;
            /** @description Free displacement unknowns, inside elements included; null when the analysis has none */
            unknowns: number | null;
            /** @description How often the mesh was refined; null when the analysis has none */
            refinements: number | null;
            /** @description Paths followed, of which the last is reported: each but the first on a mesh with every element cut in four or more, because finer meshes did not confirm what was found */
            paths: number;
            /** @description Relative error of load factors */
            accuracy: {
                /** @description What was asked for; null with a fixed mesh */
                requested: number | null;
                /** @description What was reached by estimate; null when none was made */
                estimated: number | null;
            };
        };
        /** @description What the analysis took */
        Diagnostics: {
            /** @description Steps along paths; null when the analysis has none */
            steps: number | null;
            /** @description Steps that were taken again, shorter; null when the analysis has none */
            rejected_steps: number | null;
            /** @description Newton corrections; null when the analysis has none */
            iterations: number | null;
            /** @description Factorisations of the stiffness matrix; null when the analysis has none */
            factorizations: number | null;
            /** @description Largest out-of-balance force of an accepted point, of the size of the forces; null when the analysis has none */
            max_relative_residual: number | null;
            /** @description Time of the analysis */
            wall_time_s: number;
            /** @description What was left out because nobody asked for it or the model does not need it */
            skipped: string[];
        };
        /** @description Why the analysis could not do what was asked */
        Failure: {
            /**
             * @description Code; see docs/requests.md, How an analysis ends
             * @enum {string}
             */
            code: "not_confirmed" | "step_underflow" | "no_start" | "loose_part" | "not_held" | "constant_actions" | "constant_actions_limit" | "no_convergence" | "beyond_limit_point" | "beyond_critical_point" | "fewer_modes" | "no_buckling_mode" | "mechanism" | "cancelled";
            /** @description A sentence with the deciding numbers */
            detail: string;
        };
        /** @description What an analysis found; see docs/results.md */
        Result: {
            /** @description What the model is called */
            model: {
                /** @description Title of the model */
                title: string;
                /** @description Labels of the units */
                units: components["schemas"]["Units"];
            };
            /** @description What most readers want */
            summary: components["schemas"]["Summary"];
            /** @description Points where stability changes, in the order of paths */
            critical_points: components["schemas"]["CriticalPoint"][];
            /** @description Motions without stiffness */
            neutral_motion: components["schemas"]["NeutralMotion"][];
            /** @description Where contact begins or ends, in the order of paths */
            contact_events: components["schemas"]["ContactEvent"][];
            /** @description Equilibrium paths; empty for buckling and static */
            branches: components["schemas"]["Branch"][];
            /** @description Full states, as analysis.output.states asks for them */
            states: components["schemas"]["State"][];
            /** @description Equilibrium at load factors; of type static only */
            static?: components["schemas"]["Static"];
            /** @description Load factors that were asked for and not reached */
            not_reached: number[];
            /** @description Buckling loads and modes; of type buckling only */
            buckling?: components["schemas"]["Buckling"];
            /** @description Extremes by member; only when analysis.output.extremes is true */
            extremes?: components["schemas"]["Extremes"];
            /** @description What the reader must know */
            warnings: components["schemas"]["Warning"][];
            /** @description The mesh of the result */
            discretization: components["schemas"]["MeshReport"];
            /** @description What the analysis took */
            diagnostics: components["schemas"]["Diagnostics"];
            /** @description Only when the analysis could not do what was asked */
            failure?: components["schemas"]["Failure"];
        };
        /** @description An object */
        JsonObject: {
            [key: string]: components["schemas"]["JsonValue"];
        };
        /** @description A JSON value. Lists of simple values and objects nest at most twice, as in every document here. */
        JsonValue: (null | boolean | number | string) | components["schemas"]["JsonObject"] | ((null | boolean | number | string) | components["schemas"]["JsonObject"] | ((null | boolean | number | string) | components["schemas"]["JsonObject"])[])[];
        /**
         * @description accepted: waits; running; successful; failed: could not be completed (a sweep: some rows have an error); dismissed: stopped
         * @enum {string}
         */
        Status: "accepted" | "running" | "successful" | "failed" | "dismissed";
        /** @description A resource that belongs to this one */
        Link: {
            /** @description What it is to this one: self, request, result, table, next */
            rel: string;
            /** @description Its address */
            href: string;
            /** @description Its media type */
            type: string;
        };
        /**
         * @description Code of an analysis that could not be completed: one of the result's, or one of the service's
         * @enum {string}
         */
        FailureCode: "not_confirmed" | "step_underflow" | "no_start" | "loose_part" | "not_held" | "constant_actions" | "constant_actions_limit" | "no_convergence" | "beyond_limit_point" | "beyond_critical_point" | "fewer_modes" | "no_buckling_mode" | "mechanism" | "cancelled" | "time_limit" | "memory_limit" | "internal_error" | "out_of_memory" | "crashed" | "not_stored";
        /** @description Why a job failed */
        JobError: {
            /** @description Code */
            code: components["schemas"]["FailureCode"];
            /** @description A sentence */
            detail: string;
        };
        /** @description A name that the client gives to what belongs together; has no part in what is computed */
        Label: string;
        /** @description Texts that the client keeps with a job or sweep; they have no part in what is computed */
        Metadata: {
            [key: string]: string;
        };
        /** @description Address on a host that the service allows (callback_hosts); see webhooks */
        Callback: string;
        /** @description A request with what the client notes on it; the request is stored and compared without */
        AnnotatedRequest: {
            /** @description What to analyse */
            request: components["schemas"]["Request"];
            /** @description Shown in the status; lists filter by it */
            label?: components["schemas"]["Label"];
            /** @description Shown in the status */
            metadata?: components["schemas"]["Metadata"];
            /** @description Told when it has ended */
            callback?: components["schemas"]["Callback"];
        };
        /** @description A sweep with what the client notes on it; the sweep is stored and compared without */
        AnnotatedSweep: {
            /** @description What to analyse */
            sweep: components["schemas"]["SweepDocument"];
            /** @description Shown in the status; lists filter by it */
            label?: components["schemas"]["Label"];
            /** @description Shown in the status */
            metadata?: components["schemas"]["Metadata"];
            /** @description Told when it has ended */
            callback?: components["schemas"]["Callback"];
        };
        /** @description Status of a job */
        Job: {
            /** @description Name of the job (UUID version 7) */
            id: string;
            /** @description Where it stands */
            status: components["schemas"]["Status"];
            /** @description 100 at its end, else 0: the length of a path is not known before its end */
            progress: number;
            /** @description Where it stands, as a sentence */
            message: string;
            /** @description Title of its model */
            title: string;
            /** @description Type of its analysis; empty when not known */
            analysis: string;
            /** @description How often it was begun */
            attempt: number;
            /**
             * Format: date-time
             * @description When it was handed in
             */
            created: string;
            /**
             * Format: date-time
             * @description When it was begun
             */
            started: string | null;
            /**
             * Format: date-time
             * @description When it ended
             */
            finished: string | null;
            /** @description Only where the client gave one */
            label?: components["schemas"]["Label"];
            /** @description Only where the client gave some */
            metadata?: components["schemas"]["Metadata"];
            /** @description Only where the client gave one */
            callback?: components["schemas"]["Callback"];
            /** @description Only when it failed */
            error?: components["schemas"]["JobError"];
            /** @description Related resources */
            links: components["schemas"]["Link"][];
        };
        /** @description A page of jobs */
        JobList: {
            /** @description Newest first */
            jobs: components["schemas"]["Job"][];
            /** @description next: the next page */
            links: components["schemas"]["Link"][];
        };
        /** @description A mistake in a document */
        Finding: {
            /** @description JSON Pointer to it */
            pointer: string;
            /**
             * @description Kind of mistake; see docs/requests.md and docs/sweeps.md
             * @enum {string}
             */
            code: "malformed" | "duplicate_key" | "too_deep" | "too_many_values" | "missing_field" | "unknown_field" | "wrong_type" | "unknown_value" | "ambiguous" | "duplicate" | "out_of_range" | "zero_direction" | "not_increasing" | "empty" | "too_many" | "bad_id" | "duplicate_id" | "unknown_reference" | "zero_length" | "coincident_points" | "unreached_node" | "needs_one_sided" | "needs_member" | "not_fixed" | "no_load" | "too_connected" | "mechanism" | "unsupported" | "too_many_findings" | "memory_limit" | "duplicate_name" | "excess_field" | "invalid_name" | "invalid_pointer" | "no_such_place" | "not_supported" | "overlapping_targets" | "wrong_analysis" | "unequal_counts" | "too_many_points" | "not_allowed";
            /** @description What is wrong, and the rule */
            detail: string;
        };
        /** @description An error (RFC 9457) */
        Problem: {
            /**
             * @description Kind of problem; see docs/service.md
             * @enum {string}
             */
            type: "urn:snapthrough:problem:malformed-json" | "urn:snapthrough:problem:invalid-request" | "urn:snapthrough:problem:analysis-failed" | "urn:snapthrough:problem:bad-request" | "urn:snapthrough:problem:invalid-parameter" | "urn:snapthrough:problem:invalid-header" | "urn:snapthrough:problem:unauthorized" | "urn:snapthrough:problem:foreign-origin" | "urn:snapthrough:problem:not-found" | "urn:snapthrough:problem:no-such-job" | "urn:snapthrough:problem:no-such-sweep" | "urn:snapthrough:problem:no-such-point" | "urn:snapthrough:problem:result-not-ready" | "urn:snapthrough:problem:dismissed" | "urn:snapthrough:problem:method-not-allowed" | "urn:snapthrough:problem:not-acceptable" | "urn:snapthrough:problem:already-finished" | "urn:snapthrough:problem:idempotency-key-in-use" | "urn:snapthrough:problem:nothing-to-retry" | "urn:snapthrough:problem:length-required" | "urn:snapthrough:problem:body-too-large" | "urn:snapthrough:problem:target-too-long" | "urn:snapthrough:problem:unsupported-media-type" | "urn:snapthrough:problem:idempotency-key-reused" | "urn:snapthrough:problem:queue-full" | "urn:snapthrough:problem:waiting-quota" | "urn:snapthrough:problem:rate-quota" | "urn:snapthrough:problem:storage-quota" | "urn:snapthrough:problem:headers-too-large" | "urn:snapthrough:problem:internal-error" | "urn:snapthrough:problem:unknown-method" | "urn:snapthrough:problem:store-unavailable" | "urn:snapthrough:problem:not-ready" | "urn:snapthrough:problem:overloaded" | "urn:snapthrough:problem:too-many-connections" | "urn:snapthrough:problem:table-too-large";
            /** @description The kind in words */
            title: string;
            /** @description HTTP status */
            status: number;
            /** @description What is wrong here */
            detail: string;
            /** @description Path of the request; absent when the connection was refused before a request was read */
            instance?: string;
            /** @description Id of the request, as in X-Request-Id and the log; absent likewise */
            request_id?: string;
            /** @description invalid-request, malformed-json: every mistake */
            errors?: components["schemas"]["Finding"][];
            /** @description analysis-failed: code of the failure */
            code?: components["schemas"]["FailureCode"];
            /** @description analysis-failed: the result as far as it got */
            reached?: components["schemas"]["Result"];
        };
        /** @description What is wrong with a document, or how large it is */
        Check: {
            /** @description Whether it would be accepted */
            valid: boolean;
            /** @description Every mistake */
            errors: components["schemas"]["Finding"][];
            /** @description null when it is not valid */
            size: {
                /** @description Points of the sweep; 1 for a request */
                points: number;
                /** @description Displacement unknowns of the first mesh of a point */
                unknowns: number;
            } | null;
        };
        /** @description A place that a parameter's value is written to */
        SweepTarget: {
            /** @description JSON Pointer to something in /model or /analysis */
            pointer: string;
            /**
             * @description The value to the power, times this, is written; needs numbers
             * @default 1
             */
            scale?: number;
            /**
             * @description Power of the value, such as 3 where EI goes with the third power of a thickness; needs numbers
             * @default 1
             */
            power?: number;
        };
        /** @description What varies */
        SweepParameter: {
            /** @description Name of its column; not error, point or request, and not beginning with / */
            name: string;
            /** @description Where it is written */
            targets: components["schemas"]["SweepTarget"][];
            /** @description Numbers, names, whole lists */
            values: components["schemas"]["JsonValue"][];
            /** @description How each value is named in tables: one text a value, no two alike; for values that are objects or lists */
            label?: string[];
        } | {
            /** @description Name of its column; not error, point or request, and not beginning with / */
            name: string;
            /** @description Where it is written */
            targets: components["schemas"]["SweepTarget"][];
            /** @description Numbers from one end to the other */
            range: {
                /** @description First value */
                from: number;
                /** @description Last value */
                to: number;
                /** @description Number of values, both ends included; not in a Latin hypercube, needed elsewhere */
                count?: number;
                /**
                 * @description linear: equal differences; log: equal ratios, positive ends
                 * @default linear
                 * @enum {string}
                 */
                spacing?: "linear" | "log";
            };
        };
        /** @description Which combinations of values are computed */
        SweepDesign: ("grid" | "zip") | {
            /** @description One sample in each of equal parts of every range */
            latin_hypercube: {
                /** @description Number of samples */
                samples: number;
                /** @description Seed of the random numbers */
                seed: number;
            };
        };
        /** @description The structure before values are written into it: as Model, but what a parameter writes may be left out, or be anything */
        ModelTemplate: {
            /** @description A title, echoed in the result */
            title?: components["schemas"]["JsonValue"];
            /** @description Labels of the units */
            units?: components["schemas"]["JsonValue"];
            /** @description Points that members join; each is the end of a member */
            nodes?: components["schemas"]["JsonValue"];
            /** @description Stiffnesses of members */
            sections?: components["schemas"]["JsonValue"];
            /** @description Beams */
            members?: components["schemas"]["JsonValue"];
            /** @description Nodes that are held; supports, springs or foundations must hold the structure */
            supports?: components["schemas"]["JsonValue"];
            /** @description Discrete springs to the ground */
            springs?: components["schemas"]["JsonValue"];
            /** @description Continuous elastic bases */
            foundations?: components["schemas"]["JsonValue"];
            /** @description Actions; one must be proportional and not zero unless the analysis is static */
            loads?: components["schemas"]["JsonValue"];
            /** @description Stress-free offsets of the axes */
            imperfections?: components["schemas"]["JsonValue"];
            /** @description Displacements that are recorded */
            monitors?: components["schemas"]["JsonValue"];
        };
        /** @description The analysis before values are written into it: as Analysis, but what a parameter writes may be left out, or be anything */
        AnalysisTemplate: {
            /** @description critical: the first loss of stability on the path from the unloaded state; path: the equilibrium path; buckling: linearised eigenvalues about the reference load; static: equilibrium at load_factors */
            type?: components["schemas"]["JsonValue"];
            /** @description buckling: how many loads and modes */
            modes?: components["schemas"]["JsonValue"];
            /** @description static: where equilibrium is wanted */
            load_factors?: components["schemas"]["JsonValue"];
            /** @description nonlinear: large displacements; linear: small ones, for static only */
            geometry?: components["schemas"]["JsonValue"];
            /** @description The mesh; an accuracy of 1e-3 when left out */
            discretization?: components["schemas"]["JsonValue"];
            /** @description path: what is increased from step to step */
            control?: components["schemas"]["JsonValue"];
            /** @description path: lengths of the steps */
            step?: components["schemas"]["JsonValue"];
            /** @description path: where it ends */
            stop?: components["schemas"]["JsonValue"];
            /** @description path: which bifurcated branches are followed */
            branches?: components["schemas"]["JsonValue"];
            /** @description What is given back */
            output?: components["schemas"]["JsonValue"];
        };
        /** @description A request, what varies in it, and what is wanted of each point */
        SweepDocument: {
            /** @description The structure */
            model: components["schemas"]["Model"] | components["schemas"]["ModelTemplate"];
            /** @description The analysis */
            analysis: components["schemas"]["Analysis"] | components["schemas"]["AnalysisTemplate"];
            /** @description What varies */
            parameters: components["schemas"]["SweepParameter"][];
            /** @description Which points are computed */
            design: components["schemas"]["SweepDesign"];
            /** @description Name of the last parameter: its critical point is followed along it */
            follow?: string;
            /** @description Columns of the table */
            outputs: string[];
        };
        /** @description Status of a sweep */
        Sweep: {
            /** @description Name of the sweep (UUID version 7) */
            id: string;
            /** @description Where it stands */
            status: components["schemas"]["Status"];
            /** @description How much is done */
            progress: number;
            /** @description Where it stands, as a sentence */
            message: string;
            /** @description Title of its model */
            title: string;
            /** @description Type of its analysis, whatever its parameters make of it; empty when not known */
            analysis: string;
            /** @description Points of the design */
            points: number;
            /** @description Rows by what became of them */
            counts: {
                /** @description Rows without an error */
                successful: number;
                /** @description Rows with an error */
                failed: number;
                /** @description Rows that were computed before */
                reused: number;
                /** @description Points without a row */
                remaining: number;
            };
            /**
             * Format: date-time
             * @description When it was handed in
             */
            created: string;
            /**
             * Format: date-time
             * @description When it was begun
             */
            started: string | null;
            /**
             * Format: date-time
             * @description When it ended
             */
            finished: string | null;
            /** @description Only where the client gave one */
            label?: components["schemas"]["Label"];
            /** @description Only where the client gave some */
            metadata?: components["schemas"]["Metadata"];
            /** @description Only where the client gave one */
            callback?: components["schemas"]["Callback"];
            /** @description Related resources */
            links: components["schemas"]["Link"][];
        };
        /** @description A page of sweeps */
        SweepList: {
            /** @description Newest first */
            sweeps: components["schemas"]["Sweep"][];
            /** @description next: the next page */
            links: components["schemas"]["Link"][];
        };
        /** @description Rows of a sweep, in the order of points */
        Table: {
            /** @description Names of the parameters, pointers of the outputs, and error */
            columns: string[];
            /** @description One a point that is done */
            rows: components["schemas"]["JsonValue"][][];
            /** @description Number of the point of each row */
            points: number[];
            /** @description Addresses; {point} stands for the number of a point */
            links: {
                /** @description GET: the request document of the point */
                request: string;
                /** @description POST: hands the request of the point in as a job */
                job: string;
            };
        };
        /** @description Every number that bounds the service */
        Limits: {
            /** @description Largest body of a request */
            body_bytes: number;
            /** @description Largest head of a request */
            head_bytes: number;
            /** @description Headers of a request */
            header_count: number;
            /** @description Longest path with its query */
            target_bytes: number;
            /** @description Of all requests that are being received */
            buffered_bytes: number;
            /** @description Nesting of a document */
            json_depth: number;
            /** @description Values in a document */
            json_values: number;
            /** @description Nodes of a model */
            nodes: number;
            /** @description Members of a model */
            members: number;
            /** @description Elements of a mesh */
            elements: number;
            /** @description Polynomial order of elements */
            order: number;
            /** @description Largest count of a stop rule */
            steps: number;
            /** @description Points of a sweep */
            sweep_points: number;
            /** @description Parameters of a sweep */
            sweep_parameters: number;
            /** @description Targets of a parameter */
            sweep_targets: number;
            /** @description Outputs of a sweep */
            sweep_outputs: number;
            /** @description Sweeps that are not done */
            sweeps: number;
            /** @description Rows of a table in one response */
            table_rows: number;
            /** @description Characters of a label */
            label_characters: number;
            /** @description Members of metadata */
            metadata_members: number;
            /** @description Characters of a name in metadata */
            metadata_name_characters: number;
            /** @description Characters of a text in metadata */
            metadata_value_characters: number;
            /** @description Characters of a callback */
            callback_characters: number;
            /** @description Modes of a buckling analysis */
            buckling_modes: number;
            /** @description Monitors of a model */
            monitors: number;
            /** @description Members times points_per_member */
            state_points: number;
            /** @description Connections at a time */
            connections: number;
            /** @description Streams of events at a time */
            streams: number;
            /** @description Jobs that wait */
            queue: number;
            /** @description Jobs of one owner that wait; 0: any number */
            quota_jobs_waiting: number;
            /** @description Points of one owner's sweeps without a row; 0: any number */
            quota_points_waiting: number;
            /** @description Points of sweeps that one owner may hand in or try again within an hour; 0: any number */
            quota_points_per_hour: number;
            /** @description Requests, results and rows of one owner that are kept; 0: any size */
            quota_bytes_kept: number;
            /** @description Analyses at a time */
            workers: number;
            /** @description Of one analysis; beyond it the code is time_limit */
            max_run_s: number;
            /** @description Of one analysis; beyond it the code is memory_limit */
            max_job_memory_bytes: number;
            /** @description Deaths of the process during a job before it has failed */
            max_crashes: number;
            /** @description How long a worker holds a job without news */
            lease_s: number;
            /** @description How long POST /v1/jobs waits for a result */
            default_wait_s: number;
            /** @description Longest wait that Prefer may ask for */
            longest_wait_s: number;
            /** @description How long jobs are kept after their end; 0: for ever */
            keep_jobs_s: number;
            /** @description How long an idempotency key is known */
            keep_keys_s: number;
        };
        /** @description Requests to begin with */
        Examples: {
            /** @description Each with a name */
            examples: {
                /** @description Name of the file in examples/ */
                name: string;
                /** @description The request document */
                request: components["schemas"]["Request"];
            }[];
        };
        /** @description A value */
        HopsItem: {
            /** @description Its type in .NET, such as System.Double */
            type: string;
            /** @description The value as a JSON text */
            data: string;
        };
        /** @description Values of an input or output, in lists by their path */
        HopsTree: {
            /** @description Name of the input or output */
            ParamName: string;
            /** @description Lists of values by path, such as {0} or {0;1} */
            InnerTree: {
                [key: string]: components["schemas"]["HopsItem"][];
            };
        };
        /** @description A call as Hops sends it; what is not listed here plays no role */
        HopsCall: {
            /** @description Path of the component's address; its last segment is the name */
            pointer?: string;
            /** @description One for each input of the component */
            values: components["schemas"]["HopsTree"][];
            /** @description A Grasshopper definition, of which this service takes none */
            algo?: string | null;
        } & {
            [key: string]: components["schemas"]["JsonValue"];
        };
        /** @description What a call gave; with errors there are no values */
        HopsAnswer: {
            /** @description The component; absent with errors */
            pointer?: string;
            /** @description One for each output of the component */
            values: components["schemas"]["HopsTree"][];
            /** @description What the reader of the values must know */
            warnings: string[];
            /** @description Why there are no values */
            errors: string[];
        };
        /** @description An output of a component */
        HopsOutput: {
            /** @description Its name */
            Name: string;
            /** @description What is shown on the component */
            Nickname: string;
            /** @description What it is */
            Description: string;
            /**
             * @description Its type in Grasshopper
             * @enum {string}
             */
            ParamType: "Number" | "Integer" | "Text" | "Boolean" | "Point";
            /** @description Its type in .NET */
            ResultType: string;
        };
        /** @description An input of a component */
        HopsInput: {
            /** @description Its name */
            Name: string;
            /** @description What is shown on the component */
            Nickname: string;
            /** @description Where it is written to, and its bounds */
            Description: string;
            /**
             * @description Its type in Grasshopper
             * @enum {string}
             */
            ParamType: "Number" | "Integer" | "Text" | "Boolean" | "Point";
            /** @description Its type in .NET */
            ResultType: string;
            /** @description Values that it needs */
            AtLeast: number;
            /** @description Values that it takes */
            AtMost: number;
            /** @description Whether it takes a tree */
            TreeAccess: boolean;
            /** @description What it has at the beginning */
            Default: components["schemas"]["JsonValue"];
            /** @description Least value */
            Minimum: number | null;
            /** @description Largest value */
            Maximum: number | null;
        };
        /** @description A component; with errors it has no inputs and outputs */
        HopsComponent: {
            /** @description Its address below /v1/hops */
            Uri: string;
            /** @description Its name */
            Name: string;
            /** @description What is shown on it */
            Nickname: string;
            /** @description What it computes */
            Description: string;
            /** @description For menus */
            Category: string;
            /** @description For menus */
            Subcategory: string;
            /** @description In order */
            Inputs: components["schemas"]["HopsInput"][];
            /** @description In order */
            Outputs: components["schemas"]["HopsOutput"][];
            /** @description What the user should know */
            Warnings: string[];
            /** @description What is wrong with the component */
            Errors: string[];
        };
        /** @description The service answers */
        Alive: {
            /**
             * @description It does
             * @constant
             */
            status: "ok";
        };
        /** @description An OpenAPI 3.1 document */
        Description: {
            /** @description Version of OpenAPI */
            openapi: string;
            /** @description Title and version */
            info: components["schemas"]["JsonValue"];
            /** @description Operations */
            paths: components["schemas"]["JsonValue"];
            /** @description Requests to callbacks */
            webhooks?: components["schemas"]["JsonValue"];
            /** @description Schemas */
            components: components["schemas"]["JsonValue"];
        } & {
            [key: string]: components["schemas"]["JsonValue"];
        };
        /** @description Data of a progress event of a job */
        JobProgressEvent: {
            /** @description Branch that is followed */
            branch: number;
            /** @description Step along it */
            step: number;
            /** @description Load factor there */
            load_factor: number;
            /** @description Negative eigenvalues there; -1: not counted */
            negative_eigenvalues: number;
        };
        /** @description Data of a points event: points of the path that were traced, column by column */
        PathPointsEvent: {
            /** @description Index of the branch in branches */
            branch: number[];
            /** @description Step along the branch; where one is left out so are points */
            step: number[];
            /** @description Load factors */
            load_factor: number[];
            /** @description Arc length of the path up to the point */
            arc_length: number[];
            /** @description Negative eigenvalues: 0 is stable; -1: not counted */
            negative_eigenvalues: number[];
            /** @description One for each monitor of the model, the first 100 */
            monitors: {
                /** @description The monitor */
                id: components["schemas"]["Id"];
                /** @description Its values */
                values: number[];
            }[];
        };
        /** @description Data of a critical_point event */
        CriticalPointEvent: {
            /** @description Index of the branch in branches */
            branch: number;
            /** @description Kind of the point */
            type: components["schemas"]["CriticalType"];
            /** @description Load factor there */
            load_factor: number;
            /** @description Arc length of the path up to the point */
            arc_length: number;
            /** @description Negative eigenvalues before it; -1: not counted */
            negative_before: number;
            /** @description Negative eigenvalues after it; -1: not counted */
            negative_after: number;
            /** @description Estimated relative error of the load factor; null when none was made */
            error_estimate: number | null;
            /** @description false: from the path's own mesh while it runs; true: as the result has it */
            final: boolean;
        };
        /** @description Data of a progress event of a sweep */
        SweepProgressEvent: {
            /** @description Points of the design */
            points: number;
            /** @description Rows without an error */
            successful: number;
            /** @description Rows with an error */
            failed: number;
            /** @description Rows that were computed before */
            reused: number;
            /** @description Points without a row */
            remaining: number;
        };
        /** @description The request document of a point: a Request unless the values of the point are wrong */
        PointRequest: {
            /** @description The structure */
            model: components["schemas"]["Model"] | components["schemas"]["ModelTemplate"];
            /** @description The analysis */
            analysis: components["schemas"]["Analysis"] | components["schemas"]["AnalysisTemplate"];
        };
    };
    responses: {
        /** @description Malformed: the head, a parameter, or the JSON text; a table that is too large */
        Malformed: {
            headers: {
                [name: string]: unknown;
            };
            content: {
                "application/problem+json": components["schemas"]["Problem"];
            };
        };
        /** @description A bearer key is needed */
        Unauthorized: {
            headers: {
                [name: string]: unknown;
            };
            content: {
                "application/problem+json": components["schemas"]["Problem"];
            };
        };
        /** @description A service without keys answers to local names only, and to pages of its own */
        ForeignOrigin: {
            headers: {
                [name: string]: unknown;
            };
            content: {
                "application/problem+json": components["schemas"]["Problem"];
            };
        };
        /** @description Another site's page, to a service without keys; or the owner keeps as much as it may (storage-quota) */
        Forbidden: {
            headers: {
                [name: string]: unknown;
            };
            content: {
                "application/problem+json": components["schemas"]["Problem"];
            };
        };
        /** @description Nothing of that name, or no result (yet) */
        NotFound: {
            headers: {
                [name: string]: unknown;
            };
            content: {
                "application/problem+json": components["schemas"]["Problem"];
            };
        };
        /** @description No such form */
        NotAcceptable: {
            headers: {
                [name: string]: unknown;
            };
            content: {
                "application/problem+json": components["schemas"]["Problem"];
            };
        };
        /** @description In conflict with the state of the job, the sweep or the key */
        Conflict: {
            headers: {
                [name: string]: unknown;
            };
            content: {
                "application/problem+json": components["schemas"]["Problem"];
            };
        };
        /** @description A body needs a Content-Length */
        LengthRequired: {
            headers: {
                [name: string]: unknown;
            };
            content: {
                "application/problem+json": components["schemas"]["Problem"];
            };
        };
        /** @description The body is too large */
        BodyTooLarge: {
            headers: {
                [name: string]: unknown;
            };
            content: {
                "application/problem+json": components["schemas"]["Problem"];
            };
        };
        /** @description Not application/json */
        UnsupportedMediaType: {
            headers: {
                [name: string]: unknown;
            };
            content: {
                "application/problem+json": components["schemas"]["Problem"];
            };
        };
        /** @description The document is wrong, the key came with another one, or the analysis could not be completed */
        Unprocessable: {
            headers: {
                [name: string]: unknown;
            };
            content: {
                "application/problem+json": components["schemas"]["Problem"];
            };
        };
        /** @description As many jobs, sweeps or points wait as are taken, of all or of this owner; see Retry-After */
        QueueFull: {
            headers: {
                [name: string]: unknown;
            };
            content: {
                "application/problem+json": components["schemas"]["Problem"];
            };
        };
        /** @description The service is to blame */
        InternalError: {
            headers: {
                [name: string]: unknown;
            };
            content: {
                "application/problem+json": components["schemas"]["Problem"];
            };
        };
        /** @description Not at the moment; see Retry-After */
        Unavailable: {
            headers: {
                [name: string]: unknown;
            };
            content: {
                "application/problem+json": components["schemas"]["Problem"];
            };
        };
    };
    parameters: {
        /** @description wait=N seconds (at most longest_wait_s of /v1/limits). On a POST for a job also what it is answered with: respond-async or return=minimal a job, whatever is known of its result; return=representation the result, or 202 and the job while there is none */
        Prefer: string;
        /** @description A second request with it is the first */
        IdempotencyKey: string;
        /** @description no-cache: compute although the same was computed before */
        CacheControl: string;
        /** @description Entity tag that is known */
        IfNoneMatch: string;
        /** @description The last event that was seen */
        LastEventId: string;
        /** @description Entries of a page */
        Limit: number;
        /** @description From a next link */
        Cursor: string;
        /** @description Only those of this type of analysis */
        AnalysisFilter: "buckling" | "critical" | "path" | "static";
        /** @description Only those with this label */
        LabelFilter: components["schemas"]["Label"];
        /** @description Only those that were handed in later than this */
        CreatedAfter: string;
        /** @description Only those that were handed in earlier than this */
        CreatedBefore: string;
        /** @description Only those of this status */
        StatusFilter: components["schemas"]["Status"];
        /** @description Name of the job */
        JobId: string;
        /** @description Name of the sweep */
        SweepId: string;
        /** @description Number of the point, from 0 */
        PointNumber: number;
    };
    requestBodies: never;
    headers: never;
    pathItems: never;
}
export type $defs = Record<string, never>;
export interface operations {
    listJobs: {
        parameters: {
            query?: {
                /** @description Entries of a page */
                limit?: components["parameters"]["Limit"];
                /** @description From a next link */
                cursor?: components["parameters"]["Cursor"];
                /** @description Only those of this status */
                status?: components["parameters"]["StatusFilter"];
                /** @description Only those of this type of analysis */
                analysis?: components["parameters"]["AnalysisFilter"];
                /** @description Only those with this label */
                label?: components["parameters"]["LabelFilter"];
                /** @description Only those that were handed in later than this */
                created_after?: components["parameters"]["CreatedAfter"];
                /** @description Only those that were handed in earlier than this */
                created_before?: components["parameters"]["CreatedBefore"];
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description A page */
            200: {
                headers: {
                    /** @description rel=next: the next page */
                    Link?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["JobList"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    createJob: {
        parameters: {
            query?: never;
            header?: {
                /** @description wait=N seconds (at most longest_wait_s of /v1/limits). On a POST for a job also what it is answered with: respond-async or return=minimal a job, whatever is known of its result; return=representation the result, or 202 and the job while there is none */
                Prefer?: components["parameters"]["Prefer"];
                /** @description A second request with it is the first */
                "Idempotency-Key"?: components["parameters"]["IdempotencyKey"];
                /** @description no-cache: compute although the same was computed before */
                "Cache-Control"?: components["parameters"]["CacheControl"];
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Request"] | components["schemas"]["AnnotatedRequest"];
            };
        };
        responses: {
            /** @description The result; with Prefer: return=minimal or respond-async the job, which was known already */
            200: {
                headers: {
                    /** @description Address of the job */
                    Location?: string;
                    /** @description hit: answered from a stored result; miss: computed */
                    "X-Cache"?: "hit" | "miss";
                    /** @description Which preferences were followed */
                    "Preference-Applied"?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Result"] | components["schemas"]["Job"];
                };
            };
            /** @description The job was stored */
            201: {
                headers: {
                    /** @description Address of the job */
                    Location?: string;
                    /** @description hit: answered from a stored result; miss: computed */
                    "X-Cache"?: "hit" | "miss";
                    /** @description Which preferences were followed */
                    "Preference-Applied"?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            /** @description With Prefer: return=representation only: the job, whose result is not there yet */
            202: {
                headers: {
                    /** @description Address of the job */
                    Location?: string;
                    /** @description hit: answered from a stored result; miss: computed */
                    "X-Cache"?: "hit" | "miss";
                    /** @description Seconds */
                    "Retry-After"?: number;
                    /** @description Which preferences were followed */
                    "Preference-Applied"?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["Forbidden"];
            404: components["responses"]["NotFound"];
            406: components["responses"]["NotAcceptable"];
            409: components["responses"]["Conflict"];
            411: components["responses"]["LengthRequired"];
            413: components["responses"]["BodyTooLarge"];
            415: components["responses"]["UnsupportedMediaType"];
            422: components["responses"]["Unprocessable"];
            429: components["responses"]["QueueFull"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    getJob: {
        parameters: {
            query?: never;
            header?: {
                /** @description wait=N seconds (at most longest_wait_s of /v1/limits). On a POST for a job also what it is answered with: respond-async or return=minimal a job, whatever is known of its result; return=representation the result, or 202 and the job while there is none */
                Prefer?: components["parameters"]["Prefer"];
            };
            path: {
                /** @description Name of the job */
                id: components["parameters"]["JobId"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Status */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    deleteJob: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the job */
                id: components["parameters"]["JobId"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Removed */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    getResult: {
        parameters: {
            query?: {
                /** @description Before Accept */
                format?: "json" | "csv";
                /** @description CSV: which table; by default that of the type of analysis */
                table?: "points" | "critical_points" | "static" | "buckling" | "states";
            };
            header?: {
                /** @description Entity tag that is known */
                "If-None-Match"?: components["parameters"]["IfNoneMatch"];
            };
            path: {
                /** @description Name of the job */
                id: components["parameters"]["JobId"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The result, immutable */
            200: {
                headers: {
                    /** @description Entity tag for If-None-Match */
                    ETag?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Result"];
                    "text/csv": string;
                };
            };
            /** @description As the client has it */
            304: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            406: components["responses"]["NotAcceptable"];
            422: components["responses"]["Unprocessable"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    getResultCsv: {
        parameters: {
            query?: {
                /** @description Which table; by default that of the type of analysis */
                table?: "points" | "critical_points" | "static" | "buckling" | "states";
            };
            header?: {
                /** @description Entity tag that is known */
                "If-None-Match"?: components["parameters"]["IfNoneMatch"];
            };
            path: {
                /** @description Name of the job */
                id: components["parameters"]["JobId"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The table, immutable */
            200: {
                headers: {
                    /** @description Entity tag for If-None-Match */
                    ETag?: string;
                    [name: string]: unknown;
                };
                content: {
                    "text/csv": string;
                };
            };
            /** @description As the client has it */
            304: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            422: components["responses"]["Unprocessable"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    getRequest: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the job */
                id: components["parameters"]["JobId"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Request */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Request"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    followJob: {
        parameters: {
            query?: never;
            header?: {
                /** @description The last event that was seen */
                "Last-Event-ID"?: components["parameters"]["LastEventId"];
            };
            path: {
                /** @description Name of the job */
                id: components["parameters"]["JobId"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Events until the end of the job or sweep */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/event-stream": string;
                };
            };
            /** @description Last-Event-ID is that of end: there is no more to come */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    dismissJob: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the job */
                id: components["parameters"]["JobId"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Status */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            409: components["responses"]["Conflict"];
            411: components["responses"]["LengthRequired"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    listSweeps: {
        parameters: {
            query?: {
                /** @description Entries of a page */
                limit?: components["parameters"]["Limit"];
                /** @description From a next link */
                cursor?: components["parameters"]["Cursor"];
                /** @description Only those of this status */
                status?: components["parameters"]["StatusFilter"];
                /** @description Only those of this type of analysis */
                analysis?: components["parameters"]["AnalysisFilter"];
                /** @description Only those with this label */
                label?: components["parameters"]["LabelFilter"];
                /** @description Only those that were handed in later than this */
                created_after?: components["parameters"]["CreatedAfter"];
                /** @description Only those that were handed in earlier than this */
                created_before?: components["parameters"]["CreatedBefore"];
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description A page */
            200: {
                headers: {
                    /** @description rel=next: the next page */
                    Link?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["SweepList"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    createSweep: {
        parameters: {
            query?: never;
            header?: {
                /** @description A second request with it is the first */
                "Idempotency-Key"?: components["parameters"]["IdempotencyKey"];
                /** @description no-cache: compute although the same was computed before */
                "Cache-Control"?: components["parameters"]["CacheControl"];
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["SweepDocument"] | components["schemas"]["AnnotatedSweep"];
            };
        };
        responses: {
            /** @description The sweep of this Idempotency-Key, which was known already */
            200: {
                headers: {
                    /** @description Address of the job or sweep */
                    Location?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Sweep"];
                };
            };
            /** @description The sweep was stored */
            201: {
                headers: {
                    /** @description Address of the job or sweep */
                    Location?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Sweep"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["Forbidden"];
            404: components["responses"]["NotFound"];
            409: components["responses"]["Conflict"];
            411: components["responses"]["LengthRequired"];
            413: components["responses"]["BodyTooLarge"];
            415: components["responses"]["UnsupportedMediaType"];
            422: components["responses"]["Unprocessable"];
            429: components["responses"]["QueueFull"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    getSweep: {
        parameters: {
            query?: never;
            header?: {
                /** @description wait=N seconds (at most longest_wait_s of /v1/limits). On a POST for a job also what it is answered with: respond-async or return=minimal a job, whatever is known of its result; return=representation the result, or 202 and the job while there is none */
                Prefer?: components["parameters"]["Prefer"];
            };
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Status */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Sweep"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    deleteSweep: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Removed */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    getSweepRequest: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The document */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["SweepDocument"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    getSweepTable: {
        parameters: {
            query?: {
                /** @description Before Accept */
                format?: "json" | "csv" | "ndjson";
                /** @description Only these rows */
                status?: "successful" | "failed";
                /** @description Number of the first point */
                first?: number;
                /** @description Points from there on, with a row or not */
                count?: number;
                /** @description CSV: with the columns point and request */
                links?: boolean;
            };
            header?: {
                /** @description Entity tag that is known */
                "If-None-Match"?: components["parameters"]["IfNoneMatch"];
            };
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The table */
            200: {
                headers: {
                    /** @description Entity tag for If-None-Match */
                    ETag?: string;
                    /** @description Whether every point has its row */
                    "X-Complete"?: "true" | "false";
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Table"];
                    "text/csv": string;
                    "application/x-ndjson": string;
                };
            };
            /** @description As the client has it */
            304: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            406: components["responses"]["NotAcceptable"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    getSweepCsv: {
        parameters: {
            query?: {
                /** @description Only these rows */
                status?: "successful" | "failed";
                /** @description Number of the first point */
                first?: number;
                /** @description Points from there on, with a row or not */
                count?: number;
                /** @description With the columns point and request */
                links?: boolean;
            };
            header?: {
                /** @description Entity tag that is known */
                "If-None-Match"?: components["parameters"]["IfNoneMatch"];
            };
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The table */
            200: {
                headers: {
                    /** @description Entity tag for If-None-Match */
                    ETag?: string;
                    /** @description Whether every point has its row */
                    "X-Complete"?: "true" | "false";
                    [name: string]: unknown;
                };
                content: {
                    "text/csv": string;
                };
            };
            /** @description As the client has it */
            304: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    getPointRequest: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
                /** @description Number of the point, from 0 */
                n: components["parameters"]["PointNumber"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Request; what is wrong with the point is not checked */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PointRequest"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    createPointJob: {
        parameters: {
            query?: never;
            header?: {
                /** @description wait=N seconds (at most longest_wait_s of /v1/limits). On a POST for a job also what it is answered with: respond-async or return=minimal a job, whatever is known of its result; return=representation the result, or 202 and the job while there is none */
                Prefer?: components["parameters"]["Prefer"];
                /** @description A second request with it is the first */
                "Idempotency-Key"?: components["parameters"]["IdempotencyKey"];
                /** @description no-cache: compute although the same was computed before */
                "Cache-Control"?: components["parameters"]["CacheControl"];
            };
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
                /** @description Number of the point, from 0 */
                n: components["parameters"]["PointNumber"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The result; with Prefer: return=minimal or respond-async the job, which was known already */
            200: {
                headers: {
                    /** @description Address of the job */
                    Location?: string;
                    /** @description hit: answered from a stored result; miss: computed */
                    "X-Cache"?: "hit" | "miss";
                    /** @description Which preferences were followed */
                    "Preference-Applied"?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Result"] | components["schemas"]["Job"];
                };
            };
            /** @description The job was stored */
            201: {
                headers: {
                    /** @description Address of the job */
                    Location?: string;
                    /** @description hit: answered from a stored result; miss: computed */
                    "X-Cache"?: "hit" | "miss";
                    /** @description Which preferences were followed */
                    "Preference-Applied"?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            /** @description With Prefer: return=representation only: the job, whose result is not there yet */
            202: {
                headers: {
                    /** @description Address of the job */
                    Location?: string;
                    /** @description hit: answered from a stored result; miss: computed */
                    "X-Cache"?: "hit" | "miss";
                    /** @description Seconds */
                    "Retry-After"?: number;
                    /** @description Which preferences were followed */
                    "Preference-Applied"?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["Forbidden"];
            404: components["responses"]["NotFound"];
            406: components["responses"]["NotAcceptable"];
            409: components["responses"]["Conflict"];
            411: components["responses"]["LengthRequired"];
            413: components["responses"]["BodyTooLarge"];
            422: components["responses"]["Unprocessable"];
            429: components["responses"]["QueueFull"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    followSweep: {
        parameters: {
            query?: never;
            header?: {
                /** @description The last event that was seen */
                "Last-Event-ID"?: components["parameters"]["LastEventId"];
            };
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Events until the end of the job or sweep */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/event-stream": string;
                };
            };
            /** @description Last-Event-ID is that of end: there is no more to come */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    dismissSweep: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Status */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Sweep"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            409: components["responses"]["Conflict"];
            411: components["responses"]["LengthRequired"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    retrySweep: {
        parameters: {
            query?: {
                /** @description Which rows are given up; the default */
                status?: "failed";
            };
            header?: never;
            path: {
                /** @description Name of the sweep */
                id: components["parameters"]["SweepId"];
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Status */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Sweep"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            404: components["responses"]["NotFound"];
            409: components["responses"]["Conflict"];
            411: components["responses"]["LengthRequired"];
            429: components["responses"]["QueueFull"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    listComponents: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Components by name */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsComponent"][];
                };
            };
            400: components["responses"]["Malformed"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    describeComponent: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the component */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The component */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsComponent"];
                };
            };
            /** @description Nothing but errors: the request is malformed */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsComponent"];
                };
            };
            /** @description Nothing but errors: no component of that name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsComponent"];
                };
            };
            /** @description Nothing but errors: those of the component's file, or of the service */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsComponent"];
                };
            };
            /** @description Nothing but errors: too much is being sent */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsComponent"];
                };
            };
        };
    };
    callComponent: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Name of the component */
                id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["HopsCall"];
            };
        };
        responses: {
            /** @description What the result gives for each output; warnings are those of the result */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: Malformed: the head, or the JSON text */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: A key is needed: RhinoComputeKey, or a bearer key */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: Another site's page, to a service without keys; or the owner keeps as much as it may */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: No component of that name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: A body needs a Content-Length, or chunks */
            411: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: Not application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: Values that the component does not take, a request that is wrong, or an analysis that could not be completed */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: The queue is full, or a quota is used up; Retry-After says when to try again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: The service is to blame, or the file of the component is wrong */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: No result within the longest wait, or no work is taken now; Retry-After says when to try again */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
        };
    };
    callComponentByPointer: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["HopsCall"];
            };
        };
        responses: {
            /** @description What the result gives for each output; warnings are those of the result */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: Malformed: the head, or the JSON text */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: A key is needed: RhinoComputeKey, or a bearer key */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: Another site's page, to a service without keys; or the owner keeps as much as it may */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: No component of that name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: A body needs a Content-Length, or chunks */
            411: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: Not application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: Values that the component does not take, a request that is wrong, or an analysis that could not be completed */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: The queue is full, or a quota is used up; Retry-After says when to try again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: The service is to blame, or the file of the component is wrong */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
            /** @description Nothing but errors: No result within the longest wait, or no work is taken now; Retry-After says when to try again */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HopsAnswer"];
                };
            };
        };
    };
    check: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Request"] | components["schemas"]["AnnotatedRequest"] | components["schemas"]["SweepDocument"] | components["schemas"]["AnnotatedSweep"];
            };
        };
        responses: {
            /** @description Every mistake, or the size of the analysis */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Check"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            411: components["responses"]["LengthRequired"];
            413: components["responses"]["BodyTooLarge"];
            415: components["responses"]["UnsupportedMediaType"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    getLimits: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Limits by name */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Limits"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    getDescription: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description OpenAPI 3.1 */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Description"];
                };
            };
            400: components["responses"]["Malformed"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    getExamples: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Examples */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Examples"];
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    isAlive: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description It does */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Alive"];
                };
            };
            400: components["responses"]["Malformed"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    isReady: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description It should */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Alive"];
                };
            };
            400: components["responses"]["Malformed"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    getMetrics: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Text format 0.0.4 */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/plain": string;
                };
            };
            400: components["responses"]["Malformed"];
            401: components["responses"]["Unauthorized"];
            403: components["responses"]["ForeignOrigin"];
            500: components["responses"]["InternalError"];
            503: components["responses"]["Unavailable"];
        };
    };
    tellEnd: {
        parameters: {
            query?: never;
            header: {
                /** @description Name of the message, the same when it is told again */
                "webhook-id": string;
                /** @description When this attempt was made, in seconds since 1970 */
                "webhook-timestamp": string;
                /** @description v1, and the base64 of the HMAC-SHA256 of id.timestamp.body */
                "webhook-signature": string;
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Job"] | components["schemas"]["Sweep"];
            };
        };
        responses: {
            /** @description Taken; anything else is told again after 5 s, 30 s, 2 min, 10 min, 1 h, 6 h */
            "2XX": {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
}
